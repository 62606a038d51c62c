"""Keys, tokens and attachments are as rmw_zenoh's design page and sources show them."""

from __future__ import annotations

import struct

import pytest
import zenoh
from hypothesis import given
from hypothesis import strategies as st

from ros2 import rmw_keys
from ros2.endpoints import GraphEndpoint

TOKEN = (
    "@ros2_lv/2/aac3178e146ba6f1fc6e6a4085e77f21/0/10/MS/%/%/listener/%chatter/"
    "std_msgs::msg::dds_::String_/RIHS01_abc/::,10:,:,:,,"
)
STRING = "std_msgs/msg/String"


def test_a_subscription_of_another_is_read() -> None:
    session, endpoint = rmw_keys.read_token(TOKEN) or ("", None)
    assert session == "aac3178e146ba6f1fc6e6a4085e77f21"
    assert endpoint == GraphEndpoint("/chatter", STRING, publishes=False, type_hash="RIHS01_abc")


def test_a_node_has_no_topic() -> None:
    assert rmw_keys.read_token("@ros2_lv/0/abc/0/0/NN/%/%/talker") == ("abc", None)


@pytest.mark.parametrize(
    "strange",
    ["", "a/b", "@ros2_lv/0/abc", TOKEN.replace("/MS/", "/SS/"), TOKEN.rsplit("/", 1)[0],
     TOKEN.replace("@ros2_lv", "ros2_lv")],
)  # fmt: skip
def test_what_is_no_token_of_a_topic_is_nothing(strange: str) -> None:
    assert rmw_keys.read_token(strange) is None


@given(st.text(max_size=100))
def test_no_text_raises(text: str) -> None:
    rmw_keys.read_token(text)


@pytest.mark.parametrize("publishes", [True, False])
def test_our_tokens_are_keys_that_are_read_back(publishes: bool) -> None:
    node = rmw_keys.OwnNode(3, "0123abcd", "pons")
    endpoint = GraphEndpoint("/pons/command", STRING, publishes=publishes, type_hash="RIHS01_1")
    token = node.endpoint_token(4, endpoint)
    assert rmw_keys.read_token(token) == ("0123abcd", endpoint)
    assert zenoh.KeyExpr(token).intersects(zenoh.KeyExpr(rmw_keys.all_tokens(3)))
    assert not zenoh.KeyExpr(token).intersects(zenoh.KeyExpr(rmw_keys.all_tokens(4)))
    assert rmw_keys.read_token(node.node_token()) == ("0123abcd", None)


def test_quality_of_service_is_a_text_of_numbers() -> None:
    assert rmw_keys.qos_text(reliable=True, keeps=True) == "1:1:1,1:,:,:,,"
    assert rmw_keys.qos_text(reliable=False, keeps=False) == "2:2:1,1:,:,:,,"


def test_a_topic_has_a_key_with_its_type_and_hash() -> None:
    key = rmw_keys.topic_key(0, "/base/scan", "sensor_msgs/msg/LaserScan", "RIHS01_5")
    assert key == "0/base/scan/sensor_msgs::msg::dds_::LaserScan_/RIHS01_5"
    every = rmw_keys.topic_key(0, "/base/scan", "sensor_msgs/msg/LaserScan")
    assert zenoh.KeyExpr(every).includes(zenoh.KeyExpr(key))


def test_an_attachment_has_33_bytes() -> None:
    made = rmw_keys.attachment(7, 1_800_000_000_000_000_000, bytes(range(16)))
    assert len(made) == 33
    assert struct.unpack_from("<qq", made) == (7, 1_800_000_000_000_000_000)
    assert made[16:] == b"\x10" + bytes(range(16))
