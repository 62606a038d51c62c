"""Decode the picture of a map into grey bytes. Knows PGM itself and leaves PNG to OpenCV.

OpenCV is imported only when a PNG is read: it brings numpy and some 40 MB into the process, and
our own sites are PGM. Sixteen bits become eight, colours their mean, as Nav2's map server does.
"""

from __future__ import annotations

import errno
import re
from dataclasses import dataclass
from itertools import islice
from pathlib import Path, PureWindowsPath

from maps.errors import BilingualError, SiteError
from maps.file_errors import system_reason_zh, too_long_zh
from maps.png_rows import count_rows_bytes
from wire.plain_file import read_plain_file
from wire.png import SIGNATURE, chunks_fit
from wire.site_map import MOST_IMAGE_BYTES

MAX_PIXELS = 64_000_000
"""8000 x 8000: a map of 400 m x 400 m at 0.05 m."""
MAX_UNPACKED_BYTES = 4 * MAX_PIXELS
"""Of a PNG, whose pixels may have four channels of two bytes each."""

_PGM_HEAD = re.compile(
    rb"(P[25])(?:\s|#[^\n]*\n)+(\d{1,9})(?:\s|#[^\n]*\n)+(\d{1,9})(?:\s|#[^\n]*\n)+(\d{1,9})\s"
)
_FORMATS = {
    b"\xff\xd8": "JPEG",
    b"GI": "GIF",
    b"BM": "BMP",
    b"P6": "PPM (P6)",
    b"P3": "PPM (P3)",
}
_PNG_CHANNELS = {0: 1, 2: 3, 3: 4, 4: 2, 6: 4}
"""By colour type; OpenCV unpacks a palette to colours. Source: PNG specification, "IHDR"."""


@dataclass(frozen=True, slots=True)
class GreyImage:
    """Keep grey pixels, 0 black to 255 white, first row at the top."""

    width: int
    height: int
    pixels: bytes
    opaque: bytes | None = None
    """A byte a pixel, 0 where it is not wholly opaque; None where the picture has no alpha."""


def read_image(path: Path) -> tuple[bytes, GreyImage]:
    """Return a map image's bytes, which name the map, and its pixels.

    Raises:
        SiteError: ``map_image_missing``, ``map_image_malformed`` or ``map_image_too_large``.
    """
    try:
        data = read_plain_file(path, MOST_IMAGE_BYTES)
    except OSError as error:
        if error.errno == errno.EFBIG:
            zh = f"{path}：{too_long_zh(MOST_IMAGE_BYTES)}"
            raise SiteError("map_image_too_large", f"{path}: {error.strerror}", zh) from error
        text = f"the map's image {path} cannot be read ({error.strerror})"
        zh = f"无法读取地图图像 {path}（{system_reason_zh(error)}）"
        folder = next((folder for folder in path.parents if folder.is_dir()), path.parent)
        beside, beside_zh = images_in(folder, path.name)
        raise SiteError("map_image_missing", f"{text}; {beside}", f"{zh}；{beside_zh}") from error
    return data, decode(data, path)


def images_in(folder: Path, wanted: str) -> tuple[str, str]:
    """Return which images lie in a folder, and which one is meant, in English and Chinese."""
    there = sorted(
        one.name
        for one in folder.iterdir()
        if one.suffix.lower() in {".pgm", ".png"} and one.is_file()
    )
    names = ", ".join(there)
    en, zh = f"images in {folder}: {names or 'none'}", f"{folder} 中的图像：{names or '无'}"
    wanted = PureWindowsPath(wanted).name.lower()  # which knows either slash
    meant = next((name for name in there if name.lower() == wanted), None)
    if meant is not None and not (folder / meant).is_symlink():  # a link may lead out of the folder
        en, zh = f"{en}; write 'image: {meant}'", f"{zh}；请写作'image: {meant}'"
    return en, zh


def decode(data: bytes, where: Path) -> GreyImage:
    """Decode PGM (P2, P5, at most 16 bits) or PNG.

    Raises:
        SiteError: ``map_image_malformed`` or ``map_image_too_large``.
    """
    if data.startswith(SIGNATURE):
        return _decode_png(data, where)
    head = _PGM_HEAD.match(data)
    if head is None:
        came, came_zh = _describe_format(data)
        text = f"{where}: got {came}, expected PGM (P2, P5) or PNG; convert it"
        zh = f"{where}：收到{came_zh}，应为 PGM（P2、P5）或 PNG，请先转换"
        raise SiteError("map_image_malformed", text, zh)
    return _decode_pgm(head, data, where)


def _describe_format(data: bytes) -> tuple[str, str]:
    """Return what a file that is no map image is, in English and in Chinese."""
    if not data:
        return "an empty file", "空文件"
    known = _FORMATS.get(data[:2])
    if known is not None:
        return f"a {known}", f" {known}"
    return f"a file that begins {data[:8]!r}", f"开头为 {data[:8]!r} 的文件"


def _decode_pgm(head: re.Match[bytes], data: bytes, where: Path) -> GreyImage:
    width, height, white = (int(text) for text in head.groups()[1:])
    _check_size(width, height, where)
    if not 1 <= white <= 65535:
        text, zh = (
            f"{where}: white is {white}; expected 1 to 65535",
            f"{where}：最大灰度值为 {white}",
        )
        raise SiteError("map_image_malformed", text, f"{zh}；应为 1 到 65535")
    wanted = width * height
    deep = white > 255
    if data.startswith(b"#", head.end()):
        rest = len(data) - head.end() - wanted * (2 if deep else 1)
        # Where the rest is as long as a comment, some readers pass over it, others shift the map.
        if head[1] == b"P2" or rest == data.find(b"\n", head.end()) + 1 - head.end():
            text = f"{where}: a comment (#) behind the value of white; it belongs before the size"
            zh = f"{where}：注释（#）写在最大灰度值之后，应写在尺寸之前"
            raise SiteError("map_image_malformed", text, zh)
    greys: bytes | None
    if head[1] == b"P2":
        greys = _plain_values(data[head.end() :], wanted, white, where)
    else:
        raw = bytes(memoryview(data)[head.end() : head.end() + wanted * (2 if deep else 1)])
        greys = _deep_values(raw, white) if deep else _scale_greys(raw, white)
    if greys is None or len(greys) < wanted:
        came = f"{len(data) - head.end()} bytes came"
        text = f"{where}: {width} x {height} pixels up to {white} announced, {came}"
        zh = f"{where}：文件头称有 {width} x {height} 个像素，灰度不超过 {white}"
        zh = f"{zh}；其后有 {len(data) - head.end()} 字节，与之不符"
        raise SiteError("map_image_malformed", text, zh)
    return GreyImage(width, height, greys)


def _scale_greys(raw: bytes, white: int) -> bytes | None:
    """Return 8-bit values with white at 255; None where one is whiter than white."""
    if white == 255:
        return raw
    if raw.translate(None, bytes(range(white + 1))):
        return None
    return raw.translate(bytes(min(255, round(value * 255 / white)) for value in range(256)))


def _deep_values(raw: bytes, white: int) -> bytes | None:
    """Return 8-bit values of 16-bit ones, most significant byte first."""
    import numpy as np

    values = np.frombuffer(raw[: len(raw) // 2 * 2], ">u2")
    if values.size and int(values.max()) > white:
        return None
    return np.round(values.astype(np.float32) * (255 / white)).astype(np.uint8).tobytes()


def _plain_values(body: bytes, wanted: int, white: int, where: Path) -> bytes:
    found = bytearray()
    # One at a time: a list of them all takes forty times the file.
    for match in islice(re.finditer(rb"\S+", body), wanted):
        value = _number(match[0])
        if value is None or not 0 <= value <= white:
            at = len(found) + 1
            came = repr(match[0][:20]) if value is None else match[0][:20].decode("ascii")
            text = f"{where}: pixel {at} is {came}, expected 0 to {white}"
            zh = f"{where}：第 {at} 个像素是 {came}，应为 0 到 {white}"
            raise SiteError("map_image_malformed", text, zh)
        found.append(round(value * 255 / white))
    return bytes(found)


def _number(text: bytes) -> int | None:
    try:
        return int(text)
    except ValueError:
        return None


def _decode_png(data: bytes, where: Path) -> GreyImage:
    # The header says the size before anything is unpacked: a small file may hold a huge picture.
    width, height = int.from_bytes(data[16:20]), int.from_bytes(data[20:24])
    _check_size(width, height, where)
    if not chunks_fit(data):
        text = f"{where}: {len(data)} bytes came, and its chunks speak of more"
        zh = f"{where}：文件有 {len(data)} 字节，与其数据块所述的长度不符"
        raise SiteError("map_image_malformed", text, zh)
    depth, color = data[24], data[25]
    unpacked = width * height * _PNG_CHANNELS.get(color, 4) * (2 if depth == 16 else 1)
    if not unpacked <= MAX_UNPACKED_BYTES:
        text = f"{where}: {width} x {height} pixels of colour type {color} and {depth} bits"
        zh = f"{where}：{width} x {height} 个像素，颜色类型 {color}，{depth} 位"
        zh = f"{zh}；最多 {MAX_UNPACKED_BYTES} 字节"
        raise SiteError("map_image_too_large", f"{text}; at most {MAX_UNPACKED_BYTES} bytes", zh)
    _check_rows(data, where)
    import cv2
    import numpy as np

    try:  # the bytes that name the map, not the file again: it may be another by now
        pixels = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        pixels = None
    if pixels is None or pixels.shape[:2] != (height, width):
        text, zh = f"{where}: the PNG cannot be decoded", f"{where}：PNG 无法解码"
        raise SiteError("map_image_malformed", text, zh)
    white = 65535 if pixels.dtype == np.uint16 else 255
    opaque = None
    if pixels.ndim == 3:
        if pixels.shape[2] in (2, 4):
            opaque = (pixels[:, :, -1] == white).astype(np.uint8).tobytes()
        colors = pixels[:, :, : 3 if pixels.shape[2] >= 3 else 1]
        pixels = colors.mean(axis=2, dtype=np.float32)
    if white != 255:
        pixels = pixels.astype(np.float32) * np.float32(255 / white)
    if pixels.dtype != np.uint8:
        pixels = np.round(pixels).astype(np.uint8)
    return GreyImage(width, height, pixels.tobytes(), opaque)


def _check_size(width: int, height: int, where: Path) -> None:
    text = f"{where}: {width} x {height} pixels; expected 1 to {MAX_PIXELS} in all"
    zh = f"{where}：{width} x {height} 个像素；总数应为 1 到 {MAX_PIXELS}"
    if not width * height > 0:
        raise SiteError("map_image_malformed", text, zh)
    if not width * height <= MAX_PIXELS:
        raise SiteError("map_image_too_large", text, zh)


def _check_rows(data: bytes, where: Path) -> None:
    try:
        held, wanted = count_rows_bytes(data)
    except BilingualError as error:
        raise SiteError(
            "map_image_malformed", f"{where}: {error}", f"{where}：{error.zh}"
        ) from error
    if held != wanted:
        size = f"{int.from_bytes(data[16:20])} x {int.from_bytes(data[20:24])}"
        text = f"{where}: its header says {size} pixels, which its data do not hold"
        zh = f"{where}：文件头称有 {size} 个像素，与数据不符"
        raise SiteError("map_image_malformed", text, zh)
