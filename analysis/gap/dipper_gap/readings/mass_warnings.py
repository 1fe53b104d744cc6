"""What is legal in passes.csv and hardly ever meant."""
from statistics import median

LEAST_LARGEST_T = 2.0  # a shovel's best pass brings more
MOST_T = 200.0         # the largest dippers are rated for half of it
FAR_ABOVE = 3.0        # times the median of all passes
LIKE_A_TOTAL = 0.5     # of the first pass's mass: each pass of a total is that much above the last


def mass_warnings(passes):
    """Questions about the masses of passes, a line each."""
    masses = [p.truck_mass_t for p in passes]
    usual = median(masses) if masses else 0.0
    out = []
    if 0 < max(masses, default=0) < LEAST_LARGEST_T:
        out.append(f"truck_mass_t is {max(masses):g} at most: is it in t?")
    if usual > MOST_T:
        out.append(f"a pass brought {usual:g} t in the median, and no dipper holds more than {MOST_T:g}: is it in t?")
    if passes and all(map(rise_as_totals, _truck_by_truck(passes))):
        out.append(f"truck_mass_t rises with every pass of every truck, to {max(masses):g}, as the total on a scale "
                   "does: write what each pass brought")
    else:
        out += [f"pass {p.number} of truck {p.truck} brought {p.truck_mass_t:g} t, and the median is {usual:g}: is "
                "that a reading?" for p in passes if usual > 0 and p.truck_mass_t > FAR_ABOVE * usual]
    out += [f"pass {p.number} of truck {p.truck} brought nothing: is that a reading?" for p in passes
            if p.truck_mass_t == 0]
    return out


def _truck_by_truck(passes):
    trucks = {}
    for p in passes:
        trucks.setdefault(p.truck, []).append(p.truck_mass_t)
    return trucks.values()


def rise_as_totals(masses):
    """Whether there are several passes of a truck, each far above the last."""
    return len(masses) > 1 and all(b > a + LIKE_A_TOTAL * masses[0] for a, b in zip(masses, masses[1:]))
