"""What a survey found, in words and as a picture, and the files that pile.profile takes."""
import numpy as np

from dipper_run.figures import pyplot

FILLED, LEFT_OUT = "#c2410c", "#2563eb"
MOST = 5  # islands that are listed one by one


def words(made, path):
    """Lines of text."""
    looked, s = made.looked, made.surface
    cell = s.columns.step
    angle, turned = s.face_deg
    area = (s.x[-1] - s.x[0]) * (s.y[-1] - s.y[0])
    out = [f"{path.name}: {looked.points:,} points ({made.kind}), {looked.on_bench:,} over the bench's place"
           + (f"; {looked.none:,} rows without a reading" if looked.none else ""),
           f"surface: x {s.x[0]:.2f} to {s.x[-1]:.2f} m, y {s.y[0]:.2f} to {s.y[-1]:.2f} m, up to z = {s.z.max():.2f} "
           f"m, a height each {cell[0]:.2f} x {cell[1]:.2f} m",
           f"face: {angle:.0f} degrees, its rise {abs(turned):.0f} degrees to the {'left' if turned > 0 else 'right'} "
           "of the dig's direction",
           f"gaps: {100 * s.filled.mean():.1f} % of {area:.0f} m2 not seen, filled from what is round them"
           + (f"; the largest {s.hole_m2:.1f} m2" if s.filled.any() else "")]
    left = sum(i.points for i in s.islands)
    out.append(f"left out: {s.above + left + s.columns.outside:,} points: {s.above:,} over the surface, "
               f"{left:,} in {len(s.islands)} islands that stand off it, {s.columns.outside:,} over or under the box")
    out += [f"  island at x = {i.x:.1f} m, y = {i.y:.1f} m: {i.points:,} points on {i.area_m2:.1f} m2, "
            f"{abs(i.off_m):.1f} m {'over' if i.off_m > 0 else 'under'} its surroundings" for i in s.islands[:MOST]]
    if len(s.islands) > MOST:
        out.append(f"  and {len(s.islands) - MOST} smaller ones")
    return out + [f"  {n}" for n in made.notes if not n.startswith("warning: ")] + \
        [n for n in made.notes if n.startswith("warning: ")]


def to_csv(points):
    """A section as pile.profile reads it."""
    return "x_m,z_m\n" + "".join(f"{x:.3f},{z:.3f}\n" for x, z in points)


def to_stl(surface):
    """A binary STL of the surface, seen from above counter-clockwise."""
    x, y = np.meshgrid(surface.x, surface.y, indexing="ij")
    p = np.stack([x, y, surface.z], axis=-1)
    a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    corners = np.concatenate([np.stack(three, axis=-2).reshape(-1, 3, 3) for three in ((a, b, c), (a, c, d))])
    facets = np.zeros(len(corners), np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("word", "<u2")]))
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    facets["normal"] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    facets["corners"] = corners
    return b"face by dipper survey, in W, m".ljust(80) + np.uint32(len(facets)).tobytes() + facets.tobytes()


def plot(made, title, file):
    """The surface from above and three sections with the points round them, as PNG."""
    plt = pyplot()
    s = made.surface
    columns = s.columns
    figure, axes = plt.subplots(4, 1, figsize=(10, 14), constrained_layout=True, height_ratios=[2.2, 1, 1, 1])
    dx, dy = columns.step[:2] / 2
    above = axes[0].imshow(s.z.T, origin="lower", aspect="equal", cmap="terrain",
                           extent=[s.x[0] - dx, s.x[-1] + dx, s.y[0] - dy, s.y[-1] + dy])
    figure.colorbar(above, ax=axes[0], label="z [m]", shrink=0.8)
    if s.filled.any() and not s.filled.all():
        axes[0].contourf(s.x, s.y, s.filled.T.astype(float), levels=[0.5, 1.5], colors="none", hatches=["////"])
    if s.islands:
        axes[0].plot([i.x for i in s.islands], [i.y for i in s.islands], "x", color=LEFT_OUT, label="island left out")
        axes[0].legend(loc="upper left", fontsize=8)
    axes[0].set(xlabel="x [m]", ylabel="y [m]")
    axes[0].set_title(f"{title}: from above; hatched: not seen, filled", fontsize=9, loc="left")
    n = len(s.y)
    for axis, j in zip(axes[1:], (n - 1 - n // 6, n // 2, n // 6)):
        xs, bins = np.nonzero(columns.counts[:, j])
        axis.plot(columns.x[xs], columns.z(bins + 0.5), ".", color="#8a8a8a", markersize=2, label="points")
        axis.plot(s.x, s.z[:, j], "-", color="black", linewidth=1.2, label="surface")
        gap = np.where(s.filled[:, j], s.z[:, j], np.nan)
        axis.plot(s.x, gap, "-", color=FILLED, linewidth=2.5, label="filled")
        axis.axhline(0, color="#8a8a8a", linewidth=0.6)
        axis.set(xlabel="x [m]", ylabel="z [m]", xlim=(columns.x[0], columns.x[-1]), aspect="equal")
        axis.set_title(f"section at y = {s.y[j]:.2f} m", fontsize=9, loc="left")
    axes[1].legend(loc="upper left", fontsize=8)
    figure.savefig(file, dpi=110)
    plt.close(figure)
