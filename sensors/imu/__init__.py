"""Read gyros on an I2C bus of this computer, and say their rate of turn on the wire."""
