"""Prints which region holds which part of a ray: python examples/partitions.py SCENE X Y Z DX DY DZ"""

import sys

import csgrt

scene = csgrt.load(sys.argv[1])
ray = [float(number) for number in sys.argv[2:8]]  # where it starts, in mm, and its direction
parts = scene.partitions([ray])
print(f"{'region':30} {'in':>10} {'out':>10} {'length':>10}  lengths of the direction")
for region, t_in, t_out in zip(parts["region_ids"], parts["t_in"], parts["t_out"]):
    print(f"{scene.regions[region].path:30} {t_in:10.3f} {t_out:10.3f} {t_out - t_in:10.3f}")
