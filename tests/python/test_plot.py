# SPDX-License-Identifier: BSD-3-Clause
"""restitute.plot: what the figures hold."""
import io
import xml.dom.minidom
from types import SimpleNamespace

import numpy as np
import pytest

import restitute

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("agg")
pytest.importorskip("matplotlib.pyplot")
plot = restitute.plot

SPEED, ANGLE = np.geomspace(0.01, 10, 5)[:, None], np.array([10, 30, 60])
FLAGS = np.array([[0, 0, 0], [0, 0, 0], [0, 0, 2], [2, 2, 6], [3, 3, 7]])


@pytest.fixture(autouse=True)
def closed():
    """Figures of pyplot stay until they are closed."""
    yield
    matplotlib.pyplot.close("all")


@pytest.fixture
def pairs():
    """Pairs with e_x = speed step + angle/100, of which some pass limits."""
    ex = 0.1 * np.arange(5)[:, None] + ANGLE / 100
    return SimpleNamespace(ez=np.broadcast_to(0.9 - 0.1 * np.arange(5)[:, None], (5, 3)), ex=ex,
                           flags=FLAGS)


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def svg(ax):
    image = io.BytesIO()
    plot.save(ax, image, "svg")
    return image.getvalue()


def contour_points(ax):
    """Points on all contour lines; from matplotlib 3.8 on they are in one collection."""
    return np.concatenate([path.vertices for lines in ax.collections for path in lines.get_paths()])


def crosses(ax):
    return [line.get_xydata() for line in ax.get_lines() if line.get_marker() == "x"]


def test_lines_have_a_curve_an_angle_and_cross_out_what_is_beyond_a_limit(pairs):
    ax = plot.lines(SPEED, pairs, "ex", curves=ANGLE, key="angle")
    curves = ax.get_lines()[:3]
    for k, curve in enumerate(curves):
        assert np.array_equal(curve.get_xdata(), SPEED[:, 0])
        assert np.array_equal(curve.get_ydata(), pairs.ex[:, k])
    assert len({(c.get_color(), c.get_linestyle(), c.get_marker()) for c in curves}) == 3
    beyond = FLAGS != 0
    expected = np.column_stack([np.broadcast_to(SPEED, (5, 3))[beyond], pairs.ex[beyond]])
    assert np.array_equal(crosses(ax)[0], expected)
    assert legend(ax) == ["10", "30", "60", "beyond a limit\nof the model:\n7 of 15"]
    assert ax.get_xscale() == "log" and ax.get_ylabel() == "$e_x$"


def test_points_of_rows_are_sorted_and_a_failed_row_is_a_gap():
    rows = SimpleNamespace(ez=np.array([0.3, np.nan, 0.1]), flags=np.array([0, 2, 0]))
    ax = plot.lines([3, 2, 1], rows)
    x, y = ax.get_lines()[0].get_data()
    assert x.tolist() == [1, 2, 3] and y[[0, 2]].tolist() == [0.1, 0.3] and np.isnan(y[1])
    assert ax.get_xscale() == "linear" and not crosses(ax) and ax.get_legend() is None


def test_a_map_shades_each_limit_and_names_it(pairs):
    ax = plot.map(SPEED, ANGLE, pairs)
    assert legend(ax) == ["v / cₛ too large", "a / R too large", "slide too long"]
    assert ax.get_xlim() == (0.01, 10) and ax.get_ylim() == (10, 60)
    drawn = svg(ax)
    assert drawn.count(b"<pattern") >= 3
    pairs.flags = 0 * FLAGS
    ax = plot.map(SPEED, ANGLE, pairs)
    assert ax.get_legend() is None and svg(ax).count(b"<pattern") == 0


def test_contours_run_where_the_values_are_whatever_the_order_of_rows():
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(1, 6.0), np.arange(1, 6.0)))
    order = np.random.default_rng(1).permutation(25)
    rows = SimpleNamespace(ex=(x + 10 * y)[order])
    points = contour_points(plot.map(x[order], y[order], rows, log=(False, False)))
    values = points[:, 0] + 10 * points[:, 1]
    assert np.allclose(values, 5 * np.round(values / 5)) and len(np.unique(values.round())) > 5


def test_a_node_that_is_missing_or_failed_has_no_contours():
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(4.0), np.arange(4.0)))
    rows = SimpleNamespace(ex=np.where(x + y == 6, np.nan, 5 + x))
    ax = plot.map(x[1:], y[1:], SimpleNamespace(ex=rows.ex[1:]), log=(False, False))
    points = contour_points(ax)
    assert np.all(points.sum(axis=1) >= 1) and np.all(points.sum(axis=1) <= 5)


@pytest.mark.parametrize(("low", "high", "levels"), [
    (0, 1, np.arange(11) / 10), (-0.31, 0.62, np.arange(-3, 7) / 10), (0.5, 0.50005, [])])
def test_levels_are_round_numbers_between_the_ends(low, high, levels):
    from restitute.plot.pairs import _levels

    assert np.allclose(_levels(np.array([low, high]), 1e-4), levels)


def test_values_that_do_not_vary_are_written_down():
    rows = SimpleNamespace(ez=np.full(9, 0.77921))
    x, y = (axis.ravel() for axis in np.meshgrid([1, 2, 3], [1, 2, 3]))
    assert [t.get_text() for t in plot.map(x, y, rows, "ez").texts] == [
        "restitution = 0.7792 everywhere"]


def test_a_grid_of_speeds_and_angles_has_one_curve_of_ez_over_the_normal_speed(pairs):
    speed, angle = (values.ravel() for values in np.broadcast_arrays(SPEED, ANGLE))
    rows = SimpleNamespace(ez=pairs.ez.ravel(), ex=pairs.ex.ravel(), flags=FLAGS.ravel())
    columns = {"speed_m_s": speed, "angle_deg": angle}
    first, second = plot.grid(columns, rows)
    normal = np.sort(speed * np.cos(np.radians(angle)))
    assert np.array_equal(first.get_lines()[0].get_xdata(), normal)
    assert second.get_xlabel() == "speed v (m/s)" and first.get_legend() is None
    assert second.get_legend().get_title().get_text() == "angle from the normal θ (degrees)"
    first, second = plot.grid(columns, rows, axes=("speed_m_s", "angle_deg"), contours=True)
    assert second.get_ylabel() == "angle from the normal θ (degrees)" and len(legend(second)) == 3


def test_curves_of_materials_are_named_without_folder_and_ending():
    rows = SimpleNamespace(ez=np.ones(4), ex=np.arange(4.0), flags=np.zeros(4, int))
    material = np.array(["a/steel.json"] * 2 + ["rubber"] * 2, object)
    _, ax = plot.grid({"angle_deg": [0, 30, 0, 30], "material": material}, rows)
    assert legend(ax) == ["steel", "rubber"]


@pytest.mark.parametrize(("columns", "contours", "words"), [
    ({"psi": [1, 1], "chi": [1, 1]}, False, "no columns vary"),
    ({"psi": [1, 2], "chi": [1, 2], "gamma": [1, 2]}, False, "more than two columns vary"),
    ({"material": ["a", "b"]}, False, "material has no numbers to be an axis"),
    ({"psi": [1, 2]}, True, "needs two columns"),
    ({"psi": range(16), "gamma": range(16)}, False, "16 curves of gamma: must be at most 15"),
    ({"psi": [1, 2, 3] * 3, "gamma": [1] * 3 + [2] * 3 + [3] * 2 + [2]}, True,
     "9 rows are no full grid of 3 by 3"),
    ({"psi": [1, 2, 3, 4], "material": ["a", "a", "b", "b"]}, True, "two columns of numbers")])
def test_columns_that_make_no_figure_are_refused(columns, contours, words):
    with pytest.raises(ValueError, match=words):
        plot.grid_axes(columns, contours)


def test_the_column_with_more_values_is_the_axis():
    columns = {"gamma": [1, 1, 2, 2, 2, 1], "psi": [1, 2, 3, 1, 2, 3], "chi": [1] * 6}
    assert plot.grid_axes(columns) == ("psi", "gamma")


def test_svg_has_text_as_text_no_date_and_the_same_bytes_every_time(pairs):
    def drawn():
        ax = plot.sheet(title="A $5 <b> & $6 \x01 title", note="friction 0.3 " * 30, origin="so")
        return svg(plot.map(SPEED, ANGLE, pairs, ax=ax))

    image = drawn()
    assert image == drawn()
    xml.dom.minidom.parseString(image)
    assert b"A $5 &lt;b&gt; &amp; $6   title</text>" in image
    assert b"speed (m/s)</text>" in image
    assert b"dc:date" not in image


def test_nothing_is_cut_off_and_the_legend_is_off_the_data(pairs):
    ax = plot.sheet(2, "A title", "a note")
    plot.grid({"speed_m_s": np.broadcast_to(SPEED, (5, 3)).ravel(), "angle_deg": np.tile(ANGLE, 5)},
              SimpleNamespace(ez=pairs.ez.ravel(), ex=pairs.ex.ravel(), flags=FLAGS.ravel()), ax=ax)
    svg(ax)
    figure = ax[0].figure
    page, box = figure.bbox, ax[1].get_legend().get_window_extent()
    assert box.x0 > ax[1].bbox.x1 and not box.overlaps(ax[1].bbox)
    for artist in [*ax, ax[1].get_legend()]:
        tight = artist.get_window_extent()
        assert page.x0 <= tight.x0 and tight.x1 <= page.x1 + 1 and tight.y1 <= page.y1 + 1


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_the_ending_of_a_file_says_the_format(tmp_path, ending, pairs):
    ax = plot.lines(SPEED, pairs, curves=ANGLE)
    plot.save(ax, tmp_path / f"a.{ending}")
    begin = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF-"}[ending]
    assert (tmp_path / f"a.{ending}").read_bytes().startswith(begin)


def test_another_ending_is_refused_before_anything_is_written(tmp_path, pairs):
    with pytest.raises(ValueError, match="must end in .svg, .png or .pdf"):
        plot.save(plot.lines(SPEED, pairs, curves=ANGLE), tmp_path / "a.txt")
    assert not list(tmp_path.iterdir())


def test_axes_that_are_given_are_used_and_their_number_is_checked(pairs):
    own = matplotlib.figure.Figure().add_subplot()
    assert plot.lines(SPEED, pairs, curves=ANGLE, ax=own) is own
    with pytest.raises(ValueError, match="1 axes are given, must be 2"):
        plot.grid({"psi": [1, 2]}, pairs, ax=own)


def test_a_history_has_forces_radii_and_velocities_and_tells_limits():
    impact = {"radius": 0.005, "density": 1200, "friction": 0.3, "angle": 30}
    rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
    with pytest.warns(restitute.ModelLimitWarning):
        history = restitute.history(rubber, speed=2, **impact)
    forces, radii, velocities = plot.history(history)
    assert [ax.get_title() for ax in (forces, radii, velocities)] == [
        "Forces", "Contact and stick radius", "Velocities"]
    assert forces.get_ylabel() == "force (N)"
    assert np.allclose(forces.get_lines()[1].get_ydata(), history.tangential_force)
    assert np.allclose(radii.get_lines()[0].get_ydata() / 1000, history.contact_radius)
    assert radii.get_ylabel() == "radius (mm)" and legend(radii) == ["contact", "stick"]
    assert "a / R too large" in forces.texts[0].get_text()
    numbers = restitute.history(psi=2, delta1=1, gamma=1)
    first = plot.history(numbers)[0]
    assert first.get_xlabel() == "time (T)" and not first.texts


@pytest.mark.component("table")
def test_a_table_is_drawn_over_its_range_with_its_limits_shaded():
    rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
    table = restitute.Table.build(rubber, radius=0.01, density=1200, friction=0.3,
                                  speeds=(0.01, 10), tolerance=1e-2)
    first, second = plot.table(table)
    speed, ez = first.get_lines()[0].get_data()
    assert (speed[0], speed[-1]) == pytest.approx((0.01, 10))
    assert np.array_equal(ez, table.pair(speed, 0.0, check=False).ez)
    limits = ["v / cₛ too large", "a / R too large", "slide too long"]
    assert legend(second) == limits
    assert first.get_legend_handles_labels()[1] == limits[:2]


@pytest.mark.component("fit")
def test_a_fit_shows_what_was_measured_and_what_is_left():
    impact = {"radius": 0.001, "density": 1200, "friction": 0.3, "angle": 30}
    speed = np.geomspace(0.01, 0.1, 6)
    solid = restitute.Material.kelvin_voigt(1e6, 30.0)
    truth = restitute.pair(solid, speed=speed, **impact)
    noise = 0.002 * np.array([1, -1, 1, -1, 1, -1])
    fit = restitute.fit_drop_test(ez=truth.ez + noise, contact_time=truth.contact_time,
                                  model="kelvin_voigt", speed=speed, poisson_ratio=0.5, **impact)
    first, second = plot.fit(fit)
    points, line = first.get_lines()
    assert np.array_equal(points.get_ydata(), truth.ez + noise)
    assert np.array_equal(line.get_ydata(), fit.fitted["ez"])
    assert legend(second) == ["ez", "contact time (relative)"]
    assert np.allclose(second.get_lines()[0].get_ydata(), truth.ez + noise - fit.fitted["ez"])


def test_moduli_of_a_maxwell_body_cross_at_its_relaxation_time():
    frequency = np.geomspace(0.1, 10, 21)
    ax = plot.moduli(restitute.Material.maxwell(1e6, 1e6), frequency)
    storage, loss = (line.get_ydata() for line in ax.get_lines())
    assert storage[10] == pytest.approx(loss[10]) and storage[0] < loss[0]
    ax = plot.relaxation(restitute.Material.maxwell(1e6, 1e6), [1.0])
    assert ax.get_lines()[0].get_ydata() == pytest.approx(1e6 / np.e)


def test_work_is_drawn_over_the_error_with_a_curve_a_method():
    ax = plot.work({"euler": ([1e-2, 1e-3], [1, 10]), "sync": ([1e-2, 1e-5], [1, 2])})
    assert legend(ax) == ["euler", "sync"] and ax.get_xscale() == ax.get_yscale() == "log"
    assert ax.get_lines()[1].get_ydata().tolist() == [1, 2]


@pytest.mark.component("fit")
def test_a_fit_of_moduli_is_drawn_over_the_frequency_with_relative_residuals():
    solid, frequency = restitute.Material.maxwell(1e6, 1e4), np.geomspace(0.1, 1000, 15)
    moduli = [of(2 * np.pi * frequency) for of in (solid.storage_modulus, solid.loss_modulus)]
    moduli[1] = 1.01 * moduli[1]
    fit = restitute.fit_dma(frequency, *moduli)
    first, second = plot.fit(fit)
    assert np.allclose(first.get_lines()[2].get_ydata(), moduli[1])
    fitted = fit.material.loss_modulus(2 * np.pi * frequency)
    assert np.allclose(second.get_lines()[1].get_ydata(), moduli[1] / fitted - 1)
    assert first.get_yscale() == "log" and legend(second) == ["storage", "loss"]


def test_axes_that_do_not_fit_the_pairs_are_refused(pairs):
    DomainError = restitute.DomainError
    with pytest.raises(DomainError, match=r"^x: has the shape \(4,\), must broadcast to"):
        plot.map([1, 2, 3, 4], ANGLE, pairs)
    with pytest.raises(DomainError, match=r"^curves: has the shape \(7,\), must broadcast to"):
        plot.lines(SPEED, pairs, curves=np.arange(7))
    with pytest.raises(DomainError, match="^map: .* pairs are no grid of 1 values of x by"):
        plot.map(1, ANGLE, pairs)
    with pytest.raises(DomainError, match="^quantity = 'e_z'.*ez"):
        plot.lines(SPEED, pairs, "e_z")
