/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The C99 functions that a library exports so that `noli audit ccd --library LIB.so QUERIES.csv...` can call it. Two
 * are required. Two are optional: the search for candidates, and the library's name. examples/swept_boxes.c is a
 * complete library:
 *
 *     cc -std=c99 -O2 -shared -fPIC -I PREFIX/include -o swept_boxes.so swept_boxes.c
 *     noli audit ccd --library swept_boxes.so cloth-funnel-vertex-face.csv
 *
 * A C++ library wraps its own functions in extern "C" functions of these names; the declarations below set the linkage.
 *
 * Notation
 *   t in [0, 1]    time within the step; x(t) = (1 - t) x_t0 + t x_t1 for every point
 *   vertex-face    points v | f0 f1 f2
 *   edge-edge      points a0 a1 | b0 b1
 * A point is three doubles x, y, z, so that x_t0[3 * i + axis] is a coordinate of point i at t = 0. Coordinates are
 * finite, in whatever unit of length the caller uses; they are not scaled. Faces and edges are closed and may be
 * degenerate (a face that is a segment or a point). The time interval is closed too: touching at exactly t = 1 is a
 * contact.
 *
 * Ownership: all memory is the caller's; nothing has to be kept or freed, and no pointer outlives its call. A library
 * may keep state between calls, but that state must not grow from call to call.
 * Threads: calls come one after the other, from any one thread. A library may use threads inside a call.
 * Errors: these functions must neither throw nor end the program.
 */
#pragma once

/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): this is C. */
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. It changes when a library compiled for an older version could be misunderstood. */
#define NOLI_CCD_VERSION 1

/* The first argument of noli_ccd_query. */
enum { NOLI_CCD_VERTEX_FACE = 0, NOLI_CCD_EDGE_EDGE = 1 };

/* What noli_ccd_query returns; any negative number is a failure. */
enum { NOLI_CCD_FAILED = -1, NOLI_CCD_NO_HIT = 0, NOLI_CCD_HIT = 1 };

/* Returns NOLI_CCD_VERSION, as this header had it when the library was compiled. */
uint32_t noli_ccd_version(void);

/*
 * Do the two features meet at some t in [0, 1]?
 *
 * kind             NOLI_CCD_VERTEX_FACE or NOLI_CCD_EDGE_EDGE
 * x_t0, x_t1       four points each, in the order above
 * tolerance        how far the answer may be off, as a length in the unit of the coordinates, 0 or more; 0 asks for the
 *                  best that the library can do. A library without such a parameter ignores it.
 * time_of_impact   never NULL. At a hit: when they first meet; a simulation that stops there is safe only if this is
 *                  not later than the true first time. Ignored if there is no hit. It is NaN before the call; a library
 *                  that does not compute times leaves it so.
 *
 * Returns NOLI_CCD_HIT, NOLI_CCD_NO_HIT, or something negative if it could not decide.
 */
int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double tolerance, double* time_of_impact);

/*
 * Optional: the search for candidates. `noli audit ccd --frames BEFORE AFTER` needs it: it asks for the candidates of a
 * step, then calls noli_ccd_query for each of them. `noli fuzz trajectories --library` does the same; without this
 * function it takes all pairs.
 *
 * x_t0, x_t1       3 * vertices doubles each
 * edges, faces     indices of vertices: two for each edge, three for each face
 * distance         features count as near when they come within this distance of each other during the step; 0 or more
 * found            to be called at least once for each pair of features that share no vertex and might meet: with the
 *                  indices of a vertex and a face, or of two edges, and with `data`, which is the caller's. From one
 *                  thread at a time.
 *
 * Returns 0, or something negative if it failed.
 */
typedef void (*noli_ccd_candidate)(void* data, int kind, uint32_t first, uint32_t second);
int noli_ccd_candidates(size_t vertices, const double* x_t0, const double* x_t1, size_t edges,
                        const uint32_t* edge_vertices, size_t faces, const uint32_t* face_vertices, double distance,
                        noli_ccd_candidate found, void* data);

/*
 * Optional: the library's name and version, such as "FCL 0.7.0"; reports of an audit show it. At most 100 bytes of
 * UTF-8, on one line. The string belongs to the library, and stays valid.
 */
const char* noli_ccd_description(void);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */
