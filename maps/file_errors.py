"""Say in Chinese why the system refused a file. Knows errors, no files.

Its own words are English; the Chinese sentence of a :class:`SiteError` is whole without them.
"""

from __future__ import annotations

import errno
from types import MappingProxyType
from typing import TYPE_CHECKING

from maps.errors import SiteError

if TYPE_CHECKING:
    from pathlib import Path

_SYSTEM = MappingProxyType(
    {
        errno.ENOENT: "没有这个文件或文件夹",
        errno.EACCES: "没有权限",
        errno.EPERM: "不允许这样做",
        errno.EISDIR: "它是文件夹",
        errno.ENOTDIR: "路径中有一段不是文件夹",
        errno.EEXIST: "已经存在",
        errno.ENOTEMPTY: "文件夹不是空的",
        errno.EINVAL: "不是普通文件",  # as wire.plain_file has it
        errno.ENXIO: "不是普通文件",
        errno.EFBIG: "文件过大",
        errno.EBUSY: "正被占用或写入",
        errno.ELOOP: "符号链接绕成一圈",
        errno.ENAMETOOLONG: "文件名过长",
        errno.ENOSPC: "磁盘已满",
        errno.EDQUOT: "磁盘配额已用完",
        errno.EROFS: "磁盘是只读的",
        errno.EIO: "磁盘读写出错",
        errno.EMFILE: "打开的文件过多",
        errno.ENFILE: "打开的文件过多",
        errno.EXDEV: "两个文件夹不在同一磁盘上",
    }
)


def system_reason_zh(error: OSError) -> str:
    """Return why the system refused a file, in Chinese; the error's number where it is rare."""
    return _SYSTEM.get(error.errno or 0, f"系统错误 {error.errno}")


def unwritable(path: Path, error: OSError) -> SiteError:
    """Return the refusal of a site that could not be written."""
    zh = f"无法写入 {path}：{system_reason_zh(error)}"
    return SiteError("site_unwritable", f"{path}: {error.strerror}", zh)


def too_long_zh(most_bytes: int) -> str:
    """Return the Chinese of a file that has more bytes than are read."""
    return f"文件超过 {most_bytes} 字节，最多读取这么多"
