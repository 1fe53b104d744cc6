"""Faces of known shape: where they stand, what a pass removed, and whether those of two periods differ."""
from dataclasses import replace

import numpy as np
import pytest

import synthetic
from dipper_gap.readings.face import before_and_after, binned, compare_faces, face_of, removed_area, truck_faces
from dipper_gap.readings.features import FeatureMap
from dipper_gap.readings.measured import read_measured, write_measured
from dipper_gap.readings.noise import noisy_features
from dipper_run.findings import BadInput
from other_mine import periods


def ramp(toe=10.0, angle_deg=38.0, height=8.0, at=np.arange(5.0, 30.01, 0.25)):
    """A face that rises from the toe on at an angle, with its crest behind it."""
    return at, np.clip((at - toe) * np.tan(np.radians(angle_deg)), 0, height)


def test_toe_crest_and_slope_of_a_straight_face():
    f, run = face_of(*ramp()), 8 / np.tan(np.radians(38))
    assert f["slope"] == pytest.approx(38, abs=0.2)
    assert (f["toe"], f["crest"]) == (pytest.approx(10 + 0.1 * run, abs=0.05), pytest.approx(10 + 0.9 * run, abs=0.05))
    flat = face_of(np.arange(5.0), np.zeros(5))
    assert np.isnan(flat["toe"]) and np.isnan(flat["slope"])


def test_a_slice_of_known_thickness_is_its_area_however_the_points_lie():
    before, after = ramp(), ramp(toe=10.8, at=np.arange(3.0, 28.0, 0.4))
    assert removed_area(before, after) == pytest.approx(0.8 * 8, rel=0.02)  # a parallelogram: shift times height
    assert np.isnan(removed_area(before, (before[0] + 100, before[1])))


@pytest.fixture
def folder(tmp_path):
    write_measured(synthetic.run(seed=1), tmp_path / "mine")
    return tmp_path / "mine"


def write_faces(folder, faces):
    rows = ["pass,x_m,z_m"] + [f"{p},{x:.3f},{z:.3f}" for p, (xs, zs) in faces.items() for x, z in zip(xs, zs)]
    (folder / "profile.csv").write_text("\n".join(rows) + "\n")


def test_a_folders_surveys_give_what_each_pass_removed_and_its_density(folder):
    write_faces(folder, {p: ramp(toe=9.0 + p) for p in (1, 2, 3, 4)})
    m = read_measured(folder)
    found = truck_faces(m)
    assert found["removed"] == pytest.approx([8.0], rel=0.02)
    assert found["t_a_m2"] == pytest.approx([sum(p.truck_mass_t for p in m.passes) / 24], rel=0.02)
    assert compare_faces(m, m) == ()  # of one truck each nothing shows the scatter


def test_what_a_pass_left_may_be_given_in_its_own_plane(folder):
    """Three lanes beside one another: each pass has its own face before and after it."""
    lanes = {p: (ramp(toe=10), ramp(toe=10 + 0.2 * p)) for p in (1, 2, 3)}
    rows = ["pass,x_m,z_m,after"] + [f"{p},{x:.3f},{z:.3f},{k}" for p, both in lanes.items()
                                     for k, (xs, zs) in enumerate(both) for x, z in zip(xs, zs)]
    (folder / "profile.csv").write_text("\n".join(rows) + "\n")
    m = read_measured(folder)
    assert [removed_area(*before_and_after(m, 1, p)) for p in (1, 2, 3)] == pytest.approx([1.6, 3.2, 4.8], rel=0.03)
    rows[5] = rows[5][:-1] + "2"
    (folder / "profile.csv").write_text("\n".join(rows) + "\n")
    with pytest.raises(BadInput, match="profile.csv:6: after: is 2; 0: the face before the pass, 1: after it"):
        read_measured(folder)


@pytest.mark.parametrize("scale, east, elevation, column", [
    (1, 512345, 0, "x_m"), (1, 0, 182.4, "z_m"), (1000, 0, 0, "x_m")])
def test_a_face_elsewhere_is_refused(folder, scale, east, elevation, column):
    write_faces(folder, {p: (scale * x + east, scale * z + elevation) for p, (x, z) in
                         ((p, ramp(toe=9.0 + p)) for p in (1, 2, 3))})
    with pytest.raises(BadInput, match=rf"profile.csv:2: {column}: is .* in the mine's coordinates, or in mm, perhaps"):
        read_measured(folder)


def test_a_declared_face_needs_surveys(folder):
    with (folder / "channels.yaml").open("a") as f:
        f.write("face_m: {unit: m, role: response, sigma: 0.06, common_sigma: 0.04}\n")
    with pytest.raises(BadInput, match="face_m: declared in channels.yaml, but there are no faces"):
        read_measured(folder)


def test_faces_are_features_that_say_what_a_pass_removed():
    m = synthetic.run({"pile_height": 1.0}, seed=1, faces=True)
    fmap = FeatureMap(m, [1, 2, 3])
    figures = {(c.pass_number, c.feature): v for c, v in zip(fmap.cells, fmap(
        {n: v[None] for n, v in m.signals.items()}, fmap.masses()[None])[0]) if c.channel == "face_m"}
    assert set(figures) == {(p, f) for p in (1, 2, 3) for f in ("removed", "slope", "toe", "crest")}
    load = m.passes[0].truck_mass_t
    assert figures[1, "removed"] == pytest.approx(0.8 * load / (1.9 * 4), rel=0.08)
    assert figures[1, "slope"] == pytest.approx(37, abs=0.5)
    blind = FeatureMap(m.seen_by({n: c for n, c in m.channels.items() if n != "face_m"}), [1, 2, 3])
    assert not [c for c in blind.cells if c.channel == "face_m"]


def test_a_noisy_survey_errs_as_its_sigma_says():
    """Of a removed area: the sum of two heights' errors over steps of half a metre."""
    m = synthetic.run(seed=1, faces=True)
    seen = noisy_features(m, m.channels, [1, 2, 3], replicas=400)
    at = [k for k, c in enumerate(seen.cells) if c.feature == "removed"]
    steps = len(binned(m.profiles[1, 1])[0])
    assert seen.own[:, at].std() == pytest.approx(0.06 * 0.5 * np.sqrt(2 * steps), rel=0.1)


def test_faults_of_a_survey_have_their_lines(folder):
    write_faces(folder, {1: ramp(), 2: (np.arange(3.0), np.arange(3.0))})
    with (folder / "profile.csv").open("a") as f:
        f.write("1.5,3,4\n")
    with pytest.raises(BadInput) as e:
        read_measured(folder)
    first = 2 + len(ramp()[0])
    assert any(f"profile.csv:{first}: x_m: 3 points of pass 2; 5 or more" in f for f in e.value.findings)
    assert any(f"profile.csv:{first + 3}: pass: is 1.5" in f for f in e.value.findings)


def surveyed(m, rng, angle_deg):
    """Each truck's first face at about this angle, 0.5 degrees from truck to truck."""
    faces = {(t.passes[0].truck, 1): ramp(toe=10 + 0.1 * rng.standard_normal(),
                                          angle_deg=angle_deg + 0.5 * rng.standard_normal()) for t in m.trucks()}
    return replace(m, profiles=faces)


def test_another_face_is_distinguished_from_a_like_one():
    now, before = periods([{}] * 6, [{}] * 4, 1)
    rng = np.random.default_rng(3)
    like = {f.kind: f for f in compare_faces(surveyed(now, rng, 38), surveyed(before, rng, 38))}
    other = {f.kind: f for f in compare_faces(surveyed(now, rng, 35), surveyed(before, rng, 38))}
    assert set(like) == {"slope", "toe", "crest"} and min(f.p for f in like.values()) > 0.05
    assert other["slope"].p < 0.01 and other["slope"].now == pytest.approx(35, abs=0.7)
    assert other["slope"].before == pytest.approx(38, abs=0.7)
