"""Keep people: a token is told once and kept nowhere, an id belongs to one, a removal is final."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from planner.people import MOST_PEOPLE, OWN_IDS, People, PeopleError, Role
from planner.state_database import StateDatabase
from wire.bounded_types import Name


def people_in(folder: Path) -> People:
    return People(StateDatabase(folder))


def test_a_person_is_found_by_the_token_alone_and_after_a_restart(tmp_path: Path) -> None:
    people = people_in(tmp_path)
    ana, token = people.add("Ana's  phone ", Role.VIEWER)
    assert (ana.id, ana.name, ana.role) == ("anas-phone", "Ana's phone", Role.VIEWER)
    for known in (people, people_in(tmp_path)):
        assert known.find(token) == ana
        assert known.find(token + "x") is known.find("") is known.find(ana.id) is None
        assert known.list_all() == [ana]


def test_a_token_is_one_word_of_a_command_line(tmp_path: Path) -> None:
    kept = people_in(tmp_path)
    assert all(kept.add(f"Ana {n}", Role.AGENT)[1].isalnum() for n in range(20))


def test_no_file_of_the_home_holds_a_token(tmp_path: Path) -> None:
    database = StateDatabase(tmp_path)
    _, token = People(database).add("Ana", Role.OPERATOR)
    database.close()
    for path in tmp_path.rglob("*"):
        assert token.encode() not in path.read_bytes()


def test_a_removed_person_is_nobody_and_the_name_is_free_again(tmp_path: Path) -> None:
    people = people_in(tmp_path)
    ana, token = people.add("Ana", Role.OPERATOR)
    assert people.remove("ana") == ana
    assert people.find(token) is None
    assert people_in(tmp_path).list_all() == []
    again, other = people.add("ANA", Role.VIEWER)
    assert again.id == "ana"
    assert other != token
    with pytest.raises(PeopleError, match="unknown_person: nobody is 'bob'; known: ana"):
        people.remove("bob")


@given(names=st.lists(st.text(min_size=1, max_size=64), max_size=6))
def test_every_id_is_one_that_a_record_takes_and_nobody_elses(names: list[str]) -> None:
    with TemporaryDirectory() as folder:
        people = people_in(Path(folder))
        for name in [*OWN_IDS, "妈妈的手机", *names]:
            with suppress(PeopleError):
                people.add(name, Role.VIEWER)
        ids = [person.id for person in people.list_all()]
    assert len(set(ids)) == len(ids)
    assert not OWN_IDS.intersection(ids)
    for each in ids:
        TypeAdapter(Name).validate_python(each)


def test_a_name_twice_none_and_too_many_are_refused(tmp_path: Path) -> None:
    people = people_in(tmp_path)
    people.add("Ana", Role.OPERATOR)
    with pytest.raises(PeopleError, match="person_exists"):
        people.add(" aNA", Role.VIEWER)
    for name in ("", "  ", "-!-"):
        with pytest.raises(PeopleError, match="person_unnamed"):
            people.add(name, Role.VIEWER)
    for number in range(MOST_PEOPLE - 1):
        people.add(f"guest {number}", Role.VIEWER)
    with pytest.raises(PeopleError, match="people_full"):
        people.add("one more", Role.VIEWER)
