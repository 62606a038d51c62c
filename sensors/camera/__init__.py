"""Read real cameras: of Video4Linux, of the network, RealSense; say their pictures on the wire."""
