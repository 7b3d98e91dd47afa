// The generators of the zoo; zoo.json says which issue each one is made after.
#pragma once

#include "datasets/zoo/zoo.hpp"

namespace hullbench::zoo {

// few_points.cpp: so few points that every one matters.
Input one_point();
Input two_on_a_meridian();
Input three_points();
Input four_corners();
Input three_on_a_line_and_one();
Input flat_triangle();
Input zigzag_in_degrees();
Input point_beside_a_hull_edge();
Input nearly_on_an_edge();
Input thin_corner();
Input square_and_rhombus();
Input last_bits();
Input growing_heights();
Input tiny_squares();
Input tiny_numbers();
Input ring_of_whole_numbers();
Input one_sided_outline();
Input two_rows();

// flat_points.cpp: all on a line, or nearly.
Input bent_line();
Input edge_bent_inwards();
Input narrow_strip();
Input evenly_spaced_line();
Input two_pairs_and_a_middle();
Input flat_in_degrees();
Input thin_building();
Input shallow_arc();
Input three_beside_an_axis();
Input one_far_along_the_line();
Input level_line();
Input slanted_line();
Input single_precision_triangle();

// close_points.cpp: equal or nearly equal points.
Input arcs_in_degrees();
Input coinciding_arcs();
Input three_close_two_far();
Input last_bit_twins();
Input short_edge();
Input nearly_equal_pair();
Input buildings_in_degrees();
Input crowded_sites();
Input occurrences();
Input repeated_points();
Input paused_track();
Input repeated_stops();

// lattices.cpp: rows, columns, circles, pixels.
Input tilted_lattice();
Input normalised_lattice();
Input quarter_lattice();
Input centimetres_far_away();
Input flight_lines();
Input isochrone_cells();
Input pixel_ring();
Input slanted_rows();
Input seventeen_gon();
Input octagon();
Input curve_in_an_image();
Input walls();

// clouds.cpp: many points in shapes with parts and holes.
Input two_areas();
Input large_coordinates();
Input thinned_degrees();
Input ponds();
Input blanked_tile();
Input voxels();
Input touching_squares();
Input cells();
Input sparse_clusters();
Input twenty_regions();
Input roads();
Input gaussian_cluster();
Input c_in_degrees();
Input raster_tile();
Input street_nodes();
Input shuffled_outline();

}  // namespace hullbench::zoo
