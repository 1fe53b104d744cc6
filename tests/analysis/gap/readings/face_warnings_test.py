"""Faces of a measured folder that are legal and hardly meant are asked about; sound ones are not."""
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import synthetic
from trucks import in_a_row
from dipper_gap.readings.face import truck_faces
from dipper_gap.readings.measured import read_measured, write_measured

BLIND = Path(__file__).resolve().parents[1] / "blind"


def questions(folder, change=None, more=""):
    """Of a sound folder whose rows of profile.csv, [pass, x, z, after, truck], `change` has changed."""
    write_measured(synthetic.with_noise(synthetic.run({}, seed=1, faces=True), 1), folder)
    head, *rows = (folder / "profile.csv").read_text().splitlines()
    rows = [[float(cell) for cell in row.split(",")] for row in rows]
    rows = change(rows) if change else rows
    (folder / "profile.csv").write_text("\n".join([head, *(",".join(f"{v:g}" for v in r) for r in rows)]) + "\n")
    return [q for q in read_measured(folder).questions() if q.startswith("profile.csv: ")]


def zeros(rows):
    """The points from 6 to 12 of those more than 3 m high, before pass 1."""
    high = [r for r in rows if r[0] == 1 and r[3] == 0 and r[2] > 3][:6]
    return [[*r[:2], 0.0, *r[3:]] if r in high else r for r in rows]


def test_sound_faces_raise_no_question(tmp_path):
    assert questions(tmp_path) == []
    assert questions(tmp_path, lambda rows: [[r[0], round(2 * r[1]) / 2, *r[2:]] for r in rows]) == []


@pytest.mark.parametrize("change, said", [
    (zeros, ["the face before pass 1 of truck 1: z_m is 0 in 6 points from x "]),
    (lambda rows: [[r[0], r[2], r[1], *r[3:]] for r in rows],
     ["begins to rise at x 0.247 m, and 2 more: is x_m", "its passes removed -8"]),
    (lambda rows: [[r[0], r[1] / 0.3048, r[2] / 0.3048, *r[3:]] for r in rows], ["begins to rise at x 4"]),
    (lambda rows: [[r[0], -r[1], *r[2:]] for r in rows], ["rises at", "begins to rise at x -"]),
    (lambda rows: rows + [[*r[:2], r[2] + 2, *r[3:]] for r in rows], ["two heights 2 m apart at x "]),
    (lambda rows: [[r[0] + 3, *r[1:]] for r in rows], ["pass 4 of truck 1: is not in passes.csv, and 2 more"]),
    (lambda rows: [[*r[:4], 2] for r in rows], ["pass 1 of truck 2: is not in passes.csv, and 2 more"]),
    (lambda rows: [[*r[:3], 1 - r[3], r[4]] for r in rows], ["truck 1: its passes removed -"])])
def test_others_do(tmp_path, change, said):
    found = questions(tmp_path, change)
    assert len(found) == len(said) and all(words in line for words, line in zip(said, found)), found


def test_of_two_heights_at_one_x_the_mean_is_taken_in_any_order(tmp_path):
    areas = []
    for name, order in (("up", 1), ("down", -1)):
        def twice(rows):
            return (rows + [[*r[:2], r[2] + 2 * (r[0] == 1), *r[3:]] for r in rows])[::order]

        questions(tmp_path / name, twice)
        areas.append(truck_faces(read_measured(tmp_path / name))["removed"])
    assert areas[0] == pytest.approx(areas[1])


def test_faces_without_their_channel_are_asked_about_where_the_mine_left_it_out(tmp_path):
    m = synthetic.with_noise(synthetic.run({}, seed=1, faces=True), 1)
    channels = {n: c for n, c in m.channels.items() if n != "face_m"}
    assert ["face_m" in q for q in replace(m, channels=channels).questions()] == [True]
    assert m.seen_by(channels).questions() == ()


def test_a_pass_that_some_trucks_are_not_surveyed_at_is_asked_about(tmp_path):
    """Its faces are in no comparison: a feature is one of all trucks."""
    m = in_a_row([synthetic.run({}, seed=k, faces=True) for k in range(3)])
    assert not [q for q in m.questions() if q.startswith("profile.csv")]
    fewer = replace(m, left={at: face for at, face in m.left.items() if at != (2, 3)})
    assert [q.split(":")[1].strip() for q in fewer.questions() if q.startswith("profile.csv")] == [
        "pass 3 is surveyed before and after for 2 of 3 trucks"]


def test_the_sealed_sets_faces_raise_no_question():
    folders = sorted([*BLIND.glob("measured/*"), *BLIND.glob("reference/*")])
    measured = [read_measured(f) for f in folders]
    assert len(folders) == 78 and np.all([len(m.profiles) for m in measured])
    assert not [q for m in measured for q in m.questions() if q.startswith("profile.csv")]
