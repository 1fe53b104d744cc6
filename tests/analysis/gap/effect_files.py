"""Small effect files, as a case's own folder effects/ holds them."""
FINES = """title: Fines
kind: rock
signature: mass up
parameter: {name: fill, unit: "-", low: 0, high: 0.4, scale: 0.1, source: test}
overlay:
  rock.fines_fraction: {add: 1}
"""
GAIN = FINES.replace("rock\n", "observation\n").replace("rock.fines_fraction", "observation.scale_gain").replace(
    "low: 0,", "low: -0.3,")
FRICTION = FINES.replace("rock\n", "machine\n").replace("rock.fines_fraction", "machine.crowd_friction_N")
