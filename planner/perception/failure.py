"""Own every reason why a model is refused, a picture is skipped or eyes are down. Data only.

A code is stable; its sentence stands in both languages. A skipped picture is no exception: it comes
back as a code inside the answer, and is counted.
"""

from __future__ import annotations

from types import MappingProxyType

from processes.worker_protocol import WorkerFailure

REFUSALS = MappingProxyType(
    {
        "model_missing": ("there is no such model file", "没有这个模型文件"),
        "model_unreadable": ("the model file can't be read", "无法读取模型文件"),
        "model_not_onnx": ("the file is not an ONNX model", "该文件不是 ONNX 模型"),
        "model_truncated": ("the model file is cut off", "模型文件不完整"),
        "model_too_new": (
            "the model is newer than the installed onnxruntime",
            "模型版本高于已安装的 onnxruntime",
        ),
        "model_broken": ("onnxruntime can't load the model", "onnxruntime 无法加载该模型"),
        "model_too_hungry": (
            "the model takes more memory than a detector may",
            "该模型占用的内存超过允许的上限",
        ),
        "model_not_detector": ("the model is not an object detector", "该模型不是目标检测模型"),
        "model_input_odd": ("the model wants an input we can't give", "无法提供模型要求的输入"),
        "model_size_open": (
            "the model leaves the size of its input open",
            "模型没有固定输入尺寸",
        ),
        "model_layout_unknown": (
            "the layout of the model's outputs can't be told",
            "无法判断模型输出的格式",
        ),
        "model_decoder_wrong": ("the decoder set does not fit the model", "指定的解码器与模型不符"),
        "model_names_missing": ("the model does not name its classes", "模型没有类别名称"),
        "model_names_malformed": ("the class names can't be read", "无法读取类别名称"),
        "model_names_wrong": (
            "there are not as many class names as the model has classes",
            "类别名称数量与模型不符",
        ),
        "provider_unavailable": ("the provider set can't be used here", "指定的推理后端不可用"),
    }
)
"""Why a model is refused, at the start: a person must act."""

SKIPS = MappingProxyType(
    {
        "picture_not_known": ("it is neither JPEG nor PNG", "既不是 JPEG 也不是 PNG"),
        "picture_empty": ("it has no pixels", "图像没有像素"),
        "picture_too_large": ("it has too many pixels", "图像像素过多"),
        "picture_one_channel": ("it has no colour", "图像没有颜色"),
        "picture_deep": ("it has more than 8 bits per channel", "每通道超过 8 位"),
        "picture_truncated": ("it is cut off", "图像不完整"),
        "picture_undecodable": ("it can't be decoded", "图像无法解码"),
        "picture_dark": (
            "it is black: a covered lens, or no light",
            "图像全黑：镜头被遮住或没有光线",
        ),
        "picture_size_wrong": ("it is not as large as its header says", "图像尺寸与说明不符"),
        "depth_not_known": ("its depth is no 16-bit PNG", "深度图不是 16 位 PNG"),
        "depth_truncated": ("its depth is cut off", "深度图不完整"),
        "depth_undecodable": ("its depth can't be decoded", "深度图无法解码"),
        "depth_size_wrong": ("its depth is of another size", "深度图尺寸不符"),
        "depth_empty": ("its depth is zero everywhere and was left aside", "深度图全为零，未使用"),
        "depth_of_another": ("its depth is of another instant", "深度图不属于同一时刻"),
        "detector_failed": ("the model failed on it", "模型处理该图像时出错"),
    }
)
"""Why a picture was not thought upon: it is counted, and the next one is looked at. For
``depth_empty`` it was, without its depth."""

FAILURES = MappingProxyType(
    {
        "no_detector": ("no detector is installed", "没有安装目标检测模型"),
        "detector_down": ("the vision process is down", "视觉进程未运行"),
        "detector_timed_out": ("the vision process took too long", "视觉进程超时"),
    }
)
"""Why eyes do not answer."""

REASONS = MappingProxyType({**REFUSALS, **SKIPS, **FAILURES})
"""Every code with its sentence in English and Chinese."""


class VisionFailure(WorkerFailure):
    """Say why there is no look: a model that is refused, a process that is down."""

    reasons = REASONS
