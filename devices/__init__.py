"""Talk to devices on serial lines. Below drives and sensors alike; knows no robot and no wire."""

from devices.lasting_port import LastingPort
from devices.serial_port import PORT_CURES, PortTrouble, SerialPort, list_adapters

__all__ = ["PORT_CURES", "LastingPort", "PortTrouble", "SerialPort", "list_adapters"]
