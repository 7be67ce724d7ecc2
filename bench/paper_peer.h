/* paper_peer.h - the paper's rules in plain C with OpenMP: what `lutetia bench paper` measures
 * beside the sheet, and an oracle of its tests.
 *
 *     struct paper_peer_config config = {.width = 512, .height = 512, .pigments_count = 6, .air = paper_air_default()};
 *     ...fill config.pigments...
 *     struct paper_openmp *peer = paper_openmp_create(&config);
 *     paper_openmp_write(peer, PAPER_PEER_HEIGHT, 0, height);   // and the others
 *     paper_openmp_start(peer);
 *     paper_openmp_steps(peer, 100);
 *     paper_openmp_read(peer, PAPER_PEER_FIXED, 0, out);
 *
 * The rules are those of a sheet with all parts (host/paper/model/film.c), with the
 * operations in the same order, so the bits are the same. The thesis's rule is in scene.h.
 *
 * Amounts are in grains. Threads: one thread calls; the steps use all that OpenMP has.
 */
#ifndef LUTETIA_BENCH_PAPER_PEER_H
#define LUTETIA_BENCH_PAPER_PEER_H

#include <sheet.h>

enum paper_peer_layer {
    PAPER_PEER_HEIGHT,
    PAPER_PEER_ABSORBENCY,
    PAPER_PEER_CAPACITY,
    PAPER_PEER_RESIST,
    PAPER_PEER_SURFACE_WATER,
    PAPER_PEER_WATER,
    PAPER_PEER_DRIED, /* read only */
    PAPER_PEER_SURFACE,
    PAPER_PEER_INFUSED,
    PAPER_PEER_FIXED,
    PAPER_PEER_SIZING,
    PAPER_PEER_CURRENT
};

struct paper_peer_config {
    int width, height; /* width 16 or more */
    bool torus;
    double absorbency;          /* of the stock */
    double absorbency_along[2]; /* of the stock */
    int pigments_count;
    struct paper_pigment pigments[PAPER_PIGMENTS_MAX];
    struct paper_air air;
};

struct paper_openmp;

/* Everything is 0. Errors: NULL, bench_error(). */
struct paper_openmp *paper_openmp_create(const struct paper_peer_config *config);
void paper_openmp_destroy(struct paper_openmp *o); /* takes NULL */
/* Shape: height * width numbers, rows from the top. */
void paper_openmp_write(struct paper_openmp *o, enum paper_peer_layer layer, int pigment,
                        const float *values);
void paper_openmp_read(const struct paper_openmp *o, enum paper_peer_layer layer, int pigment,
                       float *values);
/* After the layers have been written: faces and the wet area. */
void paper_openmp_start(struct paper_openmp *o);
void paper_openmp_steps(struct paper_openmp *o, int steps_count);

#endif
