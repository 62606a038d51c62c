"""Talk to devices on serial lines. Below drives and sensors alike; knows no robot and no wire."""

import logging

from devices.lasting_port import LastingPort
from devices.serial_port import PORT_CURES, PortTrouble, SerialPort, list_adapters

__all__ = ["PORT_CURES", "LastingPort", "PortTrouble", "SerialPort", "list_adapters"]

logging.getLogger("devices").addHandler(logging.NullHandler())  # commands say it in their own words
