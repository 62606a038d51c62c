"""Hear English orders with pocketsphinx: a search bound by the grammar, two free ones to doubt it.

A decoder keeps traces of what it heard: scores move a little, and a doubtful sentence may then come
out as another one. So this one never hears anything: its forks do, each of them once, side by side.
Runs in the voice process.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from functools import cached_property
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory

import pocketsphinx

from planner.voice.audio_preprocess import FRAME, prepare, quiet
from planner.voice.common_words import COMMON
from planner.voice.confidence import DecoderResult, confidence, long_pauses, stop_confidence
from planner.voice.dictionary import Dictionary
from planner.voice.grammar import (
    ANSWERS,
    CALLED_STOPS,
    OTHER_STOPS,
    PLACE,
    STOPS,
    SpokenLanguage,
    is_answer,
    is_called_stop,
    is_stop,
    language_of,
)
from planner.voice.recogniser import Recognition
from planner.voice.stop_spotter import StopSpotter
from processes.forked_job import ForkedJob

_DICTIONARY = "en-us/cmudict-en-us.dict"
_WORD = re.compile(r"[a-z']+")
_SURE = 0.5
_SURE_OF_PART = 0.6
"""Of a stop that is heard in the beginning of a recording: docs/adr/0068."""
_NARROW = {"beam": 1e-30, "pbeam": 1e-30, "wbeam": 1e-18}
"""For the free searches. The bound one loses a tenth of the orders with it."""
_BREATH_FRAMES = 45
_BEYOND_DOUBT = 0.75
"""Said by synthetic voices the other stops reach 0.86 to 0.88; other sentences stay below 0.55."""
_FRAMES_A_LETTER = 17
"""Of 10 ms: "halt" spoken slowly takes 12, and 30 where it is found in "what a nice day it is"."""
_ANSWER_TAIL_FRAMES = 62
"""Of 10 ms after its last word: by ten synthetic voices at most 61, a longer sentence has more."""
_JOINTS = frozenset({"and", "then", "the"})
_NEVER = -1e9


class Sphinx:
    """Decode by one site's grammar."""

    def __init__(self, names: Sequence[str], sentences: Sequence[str] = ()) -> None:
        """Load the model that pocketsphinx brings, about 0.2 s; see ``language_of``.

        Raises:
            OSError: it brought none.
        """
        known = Dictionary(Path(pocketsphinx.get_model_path(_DICTIONARY)))
        self.language: SpokenLanguage = language_of(names, known.__contains__, sentences)
        own = (*self.language.names, *self.language.sentences)
        named = {*chain.from_iterable(text.split() for text in own)} - {PLACE}
        forms = self.language.jsgf + STOPS + OTHER_STOPS + ANSWERS
        spoken = {*COMMON, *_WORD.findall(forms)}
        with TemporaryDirectory() as folder:  # a decoder reads its words from files alone
            (sounds := Path(folder) / "words.dict").write_text(known.cut(spoken), "utf-8")
            (likely := Path(folder) / "words.arpa").write_text(
                _unigrams(sorted({word for word in COMMON if word in known} | named)), "utf-8"
            )
            self._decoder = _decoder(sounds)
            self._free = _decoder(sounds, **_NARROW)
            model = pocketsphinx.NGramModel(self._free.config, self._free.logmath, str(likely))
        self._decoder.add_jsgf_string("orders", self.language.jsgf)
        self._decoder.add_jsgf_string("stops", STOPS)
        self._decoder.add_jsgf_string("called_stops", CALLED_STOPS)
        self._decoder.add_jsgf_string("other_stops", OTHER_STOPS)
        self._decoder.add_jsgf_string("answers", ANSWERS)
        self._free.add_allphone_file("phones", None)
        self._free.add_lm("words", model)

    def hear(
        self, pcm: bytes, rate_hz: int, channels: int, *, awaits_answer: bool = False
    ) -> Recognition:
        """Return the transcript and its confidence. Same bytes, same answer, after any other call.

        A yes or no is looked for only where ``awaits_answer`` says that a question waits for one.

        Raises:
            OSError: the system gives no process, or one crashed.
        """
        samples = prepare(pcm, rate_hz, channels)
        if samples is None:
            return Recognition("", 0.0, understood=False)
        recording = _Recording(samples, lambda: self._phones(samples))
        heard, words = self._order_or_stop(recording)
        if awaits_answer and not heard.understood and words is not None:
            return self._answer(recording, words) or heard
        return heard

    def listener(self, rate_hz: int, channels: int) -> StopSpotter:
        """Return what hears a recording while it is being spoken, for a stop alone."""

        def spot(pcm: bytes) -> Recognition | None:
            return self.spot_stop(pcm, rate_hz, channels)

        return StopSpotter(rate_hz, channels, spot)

    def spot_stop(self, pcm: bytes, rate_hz: int, channels: int) -> Recognition | None:
        """Return the stop that is all that these samples say so far, or None.

        Raises:
            OSError: the system gives no process, or one crashed.
        """
        samples = prepare(pcm, rate_hz, channels)
        if samples is None:
            return None
        with (
            ForkedJob(lambda: _decode(self._decoder, "stops", samples)) as bound,
            ForkedJob(lambda: _decode(self._free, "phones", samples)) as sounds,
        ):
            stop, phones = bound.result(), sounds.result()
        if phones is None:
            return None
        frames = len(samples) / (2 * FRAME)
        heard = _part(stop, phones, frames) if stop is not None and is_stop(stop.text) else None
        if heard is not None and heard.understood:
            return heard
        with ForkedJob(lambda: _decode(self._decoder, "called_stops", samples)) as bound:
            called = bound.result()
        if called is None or not is_called_stop(called.text):
            return heard
        found = _part(called, phones, frames)
        return found if found.understood else heard

    def _order_or_stop(self, recording: _Recording) -> tuple[Recognition, DecoderResult | None]:
        """Return the reading as an order or a stop, and the everyday words found in it."""
        samples, frames = recording.samples, recording.frames
        with (
            ForkedJob(lambda: _decode(self._free, "words", samples)) as spoken,
            ForkedJob(lambda: self._order(samples)) as bound,
        ):
            order = bound.result()
            if order is None or not self.language.is_order(order.text):
                heard = Recognition("" if order is None else order.text, 0.0, understood=False)
                free = spoken.result()
                return self._other_stop(recording, free) or heard, free
            stop = is_stop(order.text)
            phones = recording.phones if stop or not _silent_between(order, samples) else None
            free = spoken.result()
            words = None if stop else free
        if phones is not None and stop:
            sure = stop_confidence(order, phones, frames)
        else:
            sure = 0.0 if words is None else confidence(order, phones, words, frames)
        heard = Recognition(order.text, round(sure, 3), understood=sure >= _SURE)
        if not heard.understood:
            heard = self._other_stop(recording, free) or heard
        return heard, free

    def _other_stop(self, recording: _Recording, words: DecoderResult | None) -> Recognition | None:
        """Look once more at samples without an order for other ways to say stop, or return None.

        They are believed only where everyday words don't tell the sound better and where it is as
        short as they are: "bring me a cup of tea" was heard as "freeze" (docs/adr/0013).
        """
        samples, frames = recording.samples, recording.frames
        with ForkedJob(lambda: _decode(self._decoder, "other_stops", samples)) as bound:
            stop = bound.result()
        if stop is None or words is None or _is_drawn_out(stop):
            return None
        phones = recording.phones
        sure = stop_confidence(stop, phones, frames)
        if confidence(stop, phones, words, frames) < _BEYOND_DOUBT or sure < _SURE:
            return None
        return Recognition(stop.text, round(sure, 3), understood=True)

    def _answer(self, recording: _Recording, words: DecoderResult) -> Recognition | None:
        """Return the yes or no that was said and nothing else, or None.

        A yes drives, so it is believed only where it fits as well as any sounds would, everyday
        words are far behind and nothing was said after it (docs/adr/0013).
        """
        samples, frames = recording.samples, recording.frames
        with ForkedJob(lambda: _decode(self._decoder, "answers", samples)) as bound:
            answer = bound.result()
        if answer is None or not is_answer(answer.text):
            return None
        ends = max((end for word, *_, end in answer.words if not word.startswith("<")), default=0)
        if not frames - ends <= _ANSWER_TAIL_FRAMES:
            return None
        phones = recording.phones
        sure = confidence(answer, phones, words, frames)
        if sure < _BEYOND_DOUBT or stop_confidence(answer, phones, frames) < _SURE:
            return None
        return Recognition(answer.text, round(sure, 3), understood=True)

    def _phones(self, samples: bytes) -> DecoderResult:
        with ForkedJob(lambda: _decode(self._free, "phones", samples)) as sounds:
            return sounds.result() or DecoderResult(
                "", 0.0, ()
            )  # fits perfectly: nothing is believed

    def _order(self, samples: bytes) -> DecoderResult | None:
        order = _trim(_decode(self._decoder, "orders", samples))
        if order is None or is_stop(order.text) or not self.language.is_order(order.text):
            # A stop must not drown among the names, nor pay for them in its score.
            order = _decode(self._decoder, "stops", samples) or order
        return order


def _part(stop: DecoderResult, phones: DecoderResult, frames: float) -> Recognition:
    """Return the beginning of speech as a stop, and whether it is believed."""
    sure = stop_confidence(stop, phones, frames)
    return Recognition(stop.text, round(sure, 3), understood=sure >= _SURE_OF_PART)


class _Recording:
    """Hold what is heard once, and the sounds found in it: they are asked for up to three times."""

    def __init__(self, samples: bytes, decode_phones: Callable[[], DecoderResult]) -> None:
        self.samples = samples
        self.frames = len(samples) / (2 * FRAME)
        self._decode_phones = decode_phones

    @cached_property
    def phones(self) -> DecoderResult:
        return self._decode_phones()


def _decoder(sounds: Path, **beams: float) -> pocketsphinx.Decoder:
    return pocketsphinx.Decoder(
        dict=str(sounds),
        loglevel="FATAL",  # else each sentence that is no order is an error in our log
        samprate=16_000,
        lm=None,
        cmn="batch",
        silprob=0.1,
        fillprob=1e-20,
        lw=3.0,
        wip=0.1,
        allphone_ci=True,
        fwdflat=False,
        bestpath=False,  # the second pass over the lattice took 290 of 410 ms and mends nothing
        **beams,
    )


def _decode(decoder: pocketsphinx.Decoder, search: str, samples: bytes) -> DecoderResult | None:
    decoder.activate_search(search)
    decoder.start_utt()
    decoder.process_raw(samples, full_utt=True)
    decoder.end_utt()
    best = decoder.hyp()
    if best is None or not best.score > 0.0:
        return None
    words = tuple(
        (part.word, _log(part.ascore), part.start_frame, part.end_frame + 1)
        for part in decoder.seg()
        if part.word != "(NULL)"  # a joint of the grammar, no sound
    )
    return DecoderResult(best.hypstr, math.log(best.score), words) if best.hypstr else None


def _is_drawn_out(stop: DecoderResult) -> bool:
    """Return whether a short stop is laid over a longer sentence."""
    frames = sum(end - start for word, _, start, end in stop.words if not word.startswith("<"))
    return frames > _FRAMES_A_LETTER * len(stop.text.replace(" ", ""))


def _silent_between(order: DecoderResult, samples: bytes) -> bool:
    return all(quiet(samples, start, end - start) for _, _, start, end in long_pauses(order))


def _trim(order: DecoderResult | None) -> DecoderResult | None:
    """Drop a short "and" or "then" at the end: a decoder's reading of a last breath.

    The frames stay in the whole sentence's score, so words that were said there still tell.
    """
    if order is None:
        return None
    said = order.text.split()
    while len(said) > 1 and said[-1] in _JOINTS:
        said.pop()
    spoken = [word for word in order.words if not word[0].startswith("<")]
    dropped = spoken[len(said) :]
    if not dropped or sum(end - start for _, _, start, end in dropped) > _BREATH_FRAMES:
        return order
    kept = tuple(word for word in order.words if word not in dropped)
    return DecoderResult(" ".join(said), order.score, kept)


def _unigrams(words: Sequence[str]) -> str:
    """Return a language model in which any word follows any other (ARPA format)."""
    each = -math.log10(len(words) + 1)
    lines = [f"{each:.4f} {word}" for word in ("</s>", *words)]
    head = f"\\data\\\nngram 1={len(words) + 2}\n\n\\1-grams:\n-99 <s>\n"
    return f"{head}{chr(10).join(lines)}\n\n\\end\\\n"


def _log(score: float) -> float:
    return math.log(score) if score > 0.0 else _NEVER
