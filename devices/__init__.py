"""Talk to devices on serial lines. Below drives and sensors alike; knows no robot and no wire."""

from devices.lasting_port import LastingPort
from devices.serial_port import PortTrouble, SerialPort

__all__ = ["LastingPort", "PortTrouble", "SerialPort"]
