"""The surface of a scanned face whose height is known, with a shovel, dust and gaps in the way."""
import numpy as np
import pytest

import scanned_face
from dipper_run.findings import BadInput
from dipper_survey.report import to_csv, to_stl, words
from dipper_survey.site import Site
from dipper_survey.surface import Box
from dipper_survey.survey import survey

SITE = Site(scanned_face.ORIGIN, scanned_face.AZIMUTH)
BOX = Box(0, 30, 6, 24)


def scan(tmp_path, points, mine=True):
    file = tmp_path / "scan.xyz"
    np.savetxt(file, scanned_face.to_mine(points) if mine else points, fmt="%.3f")
    return file


def survey_of(tmp_path, points, site=SITE, box=BOX, **words):
    return survey(scan(tmp_path, points), site, box, **words)


def errors(surface):
    """(mean, largest) distance from the true face, of what was seen and of what was filled."""
    x, y = np.meshgrid(surface.x, surface.y, indexing="ij")
    off = np.abs(surface.z - scanned_face.height(x, y))
    return [(o.mean(), o.max()) for o in (off[~surface.filled], off[surface.filled]) if len(o)]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return survey_of(tmp_path_factory.mktemp("whole"), scanned_face.scene(150_000))


def test_the_face_comes_back_without_shovel_and_dust(whole):
    seen, filled = errors(whole.surface)
    assert seen[0] < 0.03 and seen[1] < 1.05
    assert filled[0] < 0.06 and filled[1] < 1.05
    assert 0.05 < whole.surface.filled.mean() < 0.2, "the dipper's shadow"
    assert abs(whole.surface.floor_m) < 0.02


def test_the_bench_goes_from_its_toe_to_the_rear(whole):
    s = whole.surface
    assert 12.0 < s.x[0] < 13.3 and s.x[-1] == 30
    assert (s.y[0], s.y[-1]) == (-6, 6)
    section = s.section()
    np.testing.assert_allclose(section[:, 1], scanned_face.height(section[:, 0], 0), atol=0.35)
    assert to_csv(section).startswith(f"x_m,z_m\n{s.x[0]:.3f},")


def test_what_was_left_out_and_filled_is_reported(whole, tmp_path):
    said = "\n".join(words(whole, tmp_path / "scan.xyz"))
    shovels = next(i for i in whole.surface.islands if np.hypot(i.x - 16.8, i.y) < 1)
    assert shovels.points > 3000 and 8 < shovels.area_m2 < 25 and shovels.off_m > 2
    assert f"island at x = {shovels.x:.1f} m" in said and "not seen, filled" in said
    assert whole.surface.above > 500, "dust, handle"


@pytest.mark.parametrize("n", [10_000, 20_000])
def test_thin_clouds_have_coarser_heights(tmp_path, n):
    made = survey_of(tmp_path, scanned_face.scene(n, seed=3))
    assert made.surface.columns.step[0] > 0.4
    assert all(mean < 0.15 for mean, _ in errors(made.surface))


def test_a_steep_face_and_a_heap_are_no_outliers(tmp_path):
    rng = np.random.default_rng(5)
    points = scanned_face.ground(60_000, rng)
    steep = np.clip((points[:, 0] - 15) * np.tan(np.radians(75)), 0, 9)
    heap = np.clip(2.5 - 0.8 * np.hypot(points[:, 0] - 23, points[:, 1] - 1), 0, None)
    points[:, 2] = np.maximum(steep, 0) + heap + rng.normal(0, 0.03, len(points))
    s = survey_of(tmp_path, points).surface
    assert not s.islands, s.islands
    at = np.hypot(*np.meshgrid(s.x - 23, s.y - 1, indexing="ij")).argmin()
    assert s.z.flat[at] == pytest.approx(11.5, abs=0.3)
    assert np.interp(16.5, s.x, s.z[:, 20]) == pytest.approx(1.5 * np.tan(np.radians(75)), abs=0.6)


def test_a_crest_that_hides_the_bench_ends_it(tmp_path):
    points = scanned_face.scene(60_000)
    made = survey_of(tmp_path, points[points[:, 0] < 26.2])
    assert 25.8 < made.surface.x[-1] < 26.5
    to_rear = survey_of(tmp_path, points[points[:, 0] < 26.2], to_rear=True)
    assert to_rear.surface.x[-1] == 30 and to_rear.surface.filled[-3:].all()


def test_a_cloud_of_the_face_alone_begins_where_it_is_seen(tmp_path):
    points = scanned_face.scene(60_000, shovel=False, dust=False)
    s = survey_of(tmp_path, points[points[:, 2] > 2]).surface
    assert 14.4 < s.x[0] < 15.5 and s.z[2:].min() > 1.5


def fault(tmp_path, points, site=SITE, box=BOX):
    with pytest.raises(BadInput) as e:
        survey(scan(tmp_path, points), site, box)
    return str(e.value)


def test_a_cloud_elsewhere_says_where_it_is_and_what_may_be_wrong(tmp_path):
    points = scanned_face.scene(3000)
    assert "say where W lies in the mine's coordinates: site.origin_m" in fault(tmp_path, points, Site())
    east, north, up = scanned_face.ORIGIN
    assert "is site.origin_m (easting, northing, elevation) or" in \
        fault(tmp_path, points, Site((east + 500, north, up), 37))
    mine = scanned_face.to_mine(points)
    file = tmp_path / "swapped.xyz"
    np.savetxt(file, mine[:, [1, 0, 2]], fmt="%.3f")
    with pytest.raises(BadInput, match="with easting and northing exchanged"):
        survey(file, SITE, BOX)
    np.savetxt(file, 1e3 * points, fmt="%.1f")
    with pytest.raises(BadInput, match="is it in millimetres"):
        survey(file, Site((1e4, 0, 0)), BOX)


def test_another_elevation_is_refused_or_doubted(tmp_path):
    points = scanned_face.scene(20_000)
    east, north, up = scanned_face.ORIGIN
    assert "no toe: " in fault(tmp_path, points, Site((east, north, up - 2), 37))
    low = survey_of(tmp_path, points, Site((east, north, up + 0.6), 37))
    assert any("the floor in front of the toe is at z = -0.60 m" in n for n in low.notes)
    assert "more than 1 m under the ground" in fault(tmp_path, points, Site((east, north, up + 9.9), 37))
    assert "no rock: nothing is more than" in fault(tmp_path, points[points[:, 2] < 0.1])


def test_rounded_coordinates_are_doubted(tmp_path):
    file = tmp_path / "rounded.xyz"
    np.savetxt(file, scanned_face.to_mine(scanned_face.scene(20_000)).astype(np.float32), fmt="%.3f")
    notes = survey(file, SITE, BOX).notes
    assert any(n.startswith("warning: y stands in steps of 0.5 m") for n in notes)
    assert not any("heights stand" in n for n in notes)


def test_elevations_of_exactly_0_within_the_bench_are_doubted(tmp_path):
    points = scanned_face.scene(20_000)
    hole = (scanned_face.height(points[:, 0], points[:, 1]) > 3) & (np.abs(points[:, 1]) < 2)
    for z, warns in ((points[:, 2], False), (np.where(hole, 0, points[:, 2]), True)):
        notes = survey(scan(tmp_path, np.column_stack([points[:, :2], z]), mine=False), Site(), BOX).notes
        assert any("behind the toe have an elevation of exactly 0: no data?" in n for n in notes) == warns


def test_the_stl_is_the_surface(whole):
    data = to_stl(whole.surface)
    n = int(np.frombuffer(data, "<u4", 1, 80)[0])
    nx, ny = whole.surface.z.shape
    assert n == 2 * (nx - 1) * (ny - 1) and len(data) == 84 + 50 * n
    facets = np.frombuffer(data, np.dtype([("n", "<f4", 3), ("p", "<f4", (3, 3)), ("w", "<u2")]), n, 84)
    assert (facets["n"][:, 2] > 0).all()
    assert facets["p"][..., 0].min() == np.float32(whole.surface.x[0]) and facets["p"][..., 1].max() == 6


@pytest.mark.parametrize("change, said", [
    (lambda p: p[:, [0, 2, 1]], "with the second and third column exchanged"),
    (lambda p: np.column_stack([p[:, 0], p[:, 2], -p[:, 1]]), "with y up, as x, -z, y"),
    (lambda p: p / 0.3048, "read as feet"), (lambda p: p - [500_000, 7_400_000, 0], "shifted by 500000, 7400000 m")])
def test_a_cloud_elsewhere_is_tried_in_other_readings(tmp_path, change, said):
    file = tmp_path / "other.xyz"
    np.savetxt(file, change(scanned_face.to_mine(scanned_face.scene(3000))), fmt="%.3f")
    with pytest.raises(BadInput, match=said):
        survey(file, SITE, BOX)


def test_a_turned_azimuth_is_doubted(tmp_path):
    points = scanned_face.scene(30_000, shovel=False, dust=False)
    east, north, up = scanned_face.ORIGIN
    turned = survey_of(tmp_path, points, Site((east, north, up), 37 - 25))
    assert any("is site.azimuth_deg clockwise from grid north?" in n for n in turned.notes)
    assert not any("azimuth" in n for n in survey_of(tmp_path, points).notes)


@pytest.mark.parametrize("slope, warned", [(75, "stands at 7"), (38, None), (8, "stands at ")])
def test_a_face_too_steep_or_flat_for_blasted_rock_is_doubted(tmp_path, slope, warned):
    """As where elevations are in feet over metres, or the other way round."""
    points = scanned_face.ground(30_000, np.random.default_rng(7))
    face = np.clip((points[:, 0] - 13) * np.tan(np.radians(slope)), 0, 9)
    points[:, 2] = face + np.random.default_rng(8).normal(0, 0.03, len(points))
    made = survey_of(tmp_path, points, box=Box(0, 30, 6, 30))
    said = [n for n in made.notes if "are the elevations in another unit than easting and northing?" in n]
    assert len(said) == (warned is not None) and all(warned in n for n in said), made.notes
    angle, _ = made.surface.face_deg
    assert angle == pytest.approx(slope, abs=6 if slope > 60 else 1.5)
