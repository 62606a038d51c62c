"""Ports are listed from the kernel's own files: by lasting names, with owners, without phantoms."""

from __future__ import annotations

import grp
import os
from pathlib import Path

import pytest

from devices.port_listing import (
    PORT_TAKERS,
    UsbIdentity,
    describe_port,
    find_port_takers,
    list_ports,
)

CP2102 = {"idVendor": "10c4", "idProduct": "ea60", "manufacturer": "Silicon Labs",
          "product": "CP2102", "serial": "0001"}  # fmt: skip


class Machine:
    """Make the files by which a kernel tells of serial ports."""

    def __init__(self, root: Path) -> None:
        self.root = root
        for name in ("sys/class/tty", "dev/serial/by-id", "dev/serial/by-path", "proc"):
            (root / name).mkdir(parents=True)

    def plug(self, name: str, slot: str, usb: dict[str, str] | None = None) -> Path:
        """Put a device at a slot; return its port."""
        device = self.root / "sys/devices" / slot
        (device / "tty1").mkdir(parents=True)
        for key, value in (usb or {}).items():
            (device / key).write_text(f"{value}\n")
        (self.root / "sys/class/tty" / name).mkdir()
        (self.root / "sys/class/tty" / name / "device").symlink_to(device / "tty1")
        port = self.root / "dev" / name
        port.touch()
        return port

    def name(self, folder: str, link: str, port: Path) -> Path:
        path = self.root / "dev/serial" / folder / link
        path.unlink(missing_ok=True)
        path.symlink_to(port)
        return path


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    return Machine(tmp_path)


def test_a_machine_without_ports_has_none(tmp_path: Path, machine: Machine) -> None:
    assert list_ports(tmp_path / "nothing") == []
    assert list_ports(machine.root) == []


def test_an_adapter_is_listed_by_the_name_that_lasts(machine: Machine) -> None:
    port = machine.plug("ttyUSB0", "usb1/1-2", CP2102)
    by_path = machine.name("by-path", "pci-usb-0:2", port)
    assert list_ports(machine.root)[0].lasting == by_path
    by_id = machine.name("by-id", "usb-Silicon_Labs_CP2102_0001", port)
    (found,) = list_ports(machine.root)
    assert (found.path, found.lasting) == (port, by_id)
    assert found.usb == UsbIdentity("10c4", "ea60", "Silicon Labs", "CP2102", "0001")
    assert not found.is_console
    assert found.twins == ()


def test_two_that_call_themselves_alike_are_told_apart_by_their_sockets(machine: Machine) -> None:
    ports = [machine.plug(f"ttyUSB{k}", f"usb1/1-{k}", CP2102) for k in range(2)]
    machine.name("by-id", "usb-Silicon_Labs_CP2102_0001", ports[1])  # the one plugged last has it
    paths = [machine.name("by-path", f"pci-usb-0:{k}", port) for k, port in enumerate(ports)]
    found = list_ports(machine.root)
    assert [one.lasting for one in found] == paths
    assert [one.twins for one in found] == [(ports[1],), (ports[0],)]


def test_phantoms_and_other_terminals_are_left_out_and_a_console_is_marked(
    machine: Machine,
) -> None:
    machine.plug("ttyS0", "pnp/0")
    machine.plug("ttyS1", "serial8250")
    machine.plug("rfcomm0", "bluetooth")
    tty = machine.root / "sys/class/tty"
    (tty / "ttyS0/type").write_text("4\n")
    (tty / "ttyS1/type").write_text("0\n")
    (tty / "tty1").mkdir()  # a screen: no device behind it
    (tty / "console").mkdir()
    (tty / "console/active").write_text("tty0 ttyS0\n")
    (found,) = list_ports(machine.root)
    assert (found.path.name, found.is_console, found.usb) == ("ttyS0", True, None)


def test_who_holds_a_port_is_named(machine: Machine) -> None:
    port = machine.plug("ttyACM0", "usb1/1-3", CP2102)
    process = machine.root / "proc/812"
    (process / "fd").mkdir(parents=True)
    (process / "cmdline").write_bytes(b"/opt/pons/.venv/bin/python\0-m\0bridge\0")
    (process / "comm").write_text("python\n")
    (process / "fd/7").symlink_to(port)
    (found,) = list_ports(machine.root)
    assert [(one.pid, one.command) for one in found.holders] == [(812, "python -m bridge")]
    assert find_port_takers(machine.root) == ()
    for name in PORT_TAKERS:
        (process / "comm").write_text(f"{name}\n")
        assert find_port_takers(machine.root) == (name,)


def test_a_port_named_by_a_person_is_described_though_the_kernel_tells_nothing(
    tmp_path: Path,
) -> None:
    found = describe_port(tmp_path / "none")
    assert (found.usb, found.holders, found.is_permitted) == (None, (), False)
    assert describe_port(Path(os.devnull)).is_permitted


def test_a_group_is_named_only_where_it_helps_to_join_it(machine: Machine) -> None:
    port = machine.plug("ttyUSB0", "usb1/1-2", CP2102)
    port.chmod(0o600)
    assert list_ports(machine.root)[0].group == ""
    port.chmod(0o660)
    gid = port.stat().st_gid
    wanted = grp.getgrgid(gid).gr_name if gid else ""  # nobody should join root's
    assert list_ports(machine.root)[0].group == wanted


def test_who_holds_what_is_no_terminal_is_no_affair_of_ours() -> None:
    with Path(os.devnull).open("rb"):
        assert describe_port(Path(os.devnull)).holders == ()
