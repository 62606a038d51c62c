"""Own the learned reader: units of a sentence, the closed plan grammar, network, decoding."""
