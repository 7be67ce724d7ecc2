"""Heat spreads over a plate of a million processors from one hot column. Run it in `./run shell`: python3 heat.py"""
import numpy
import paris
from paris import *

CM_init()
CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry([1000, 1000], 2)))
heat, east, west = (CM_allocate_heap_field(32) for _ in range(3))

plate = numpy.zeros((1000, 1000), "f4")
plate[:, 500] = 100
paris.write(heat, plate)

for step in range(100):
    CM_get_from_news_1L(east, heat, 1, CM_upward, 32)
    CM_get_from_news_1L(west, heat, 1, CM_downward, 32)
    CM_f_add_2_1L(east, west, 23, 8)
    CM_f_multiply_constant_2_1L(east, 0.25, 23, 8)
    CM_f_multiply_constant_2_1L(heat, 0.5, 23, 8)
    CM_f_add_2_1L(heat, east, 23, 8)

plate = paris.read(heat, "f4")
print(f"hottest: {plate.max():g}, in column {plate.max(axis=0).argmax()}; the sum is {plate.sum(dtype='f8'):g}")
