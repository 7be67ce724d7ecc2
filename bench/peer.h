/* peer.h - a peer of the diffusion benchmark that is a script: a child process that takes steps
 * when it is asked to, so that it can take turns with the others.
 *
 *     struct bench_peer *p = bench_peer_start(&scene, kernel_numpy_peer_py, NULL, &missing);
 *     bench_peer_steps(p, 4);
 *     bench_peer_read(p, DIFFUSION_WATER, array);
 *     bench_peer_stop(p);
 *
 * It reads from its standard input, and answers on its standard output:
 *
 *     width height x0 y0 x1 y1 gravity weight weight weight, a line; the last four as %a
 *     absorbency, four fields: rows of floats        -> "ready"
 *     "steps N"                                      -> "done"
 *     "read I"                                       -> field I, rows of floats
 *
 * It exits with 3 where what it needs is not installed.
 * Errors. Functions that can fail return NULL or false, and bench_error() says why. */
#ifndef LUTETIA_BENCH_PEER_H
#define LUTETIA_BENCH_PEER_H

#include "scene.h"

struct bench_peer;
/* script: the text of a Python program; argument: its one argument, or NULL. NULL with *missing
 * set: not installed here, which is no error. */
struct bench_peer *bench_peer_start(const struct diffusion_scene *s, const char *script,
                                    const char *argument, bool *missing);
void bench_peer_stop(struct bench_peer *p); /* takes NULL */
bool bench_peer_steps(struct bench_peer *p, int steps_count);
bool bench_peer_read(struct bench_peer *p, int field, float *out);

#endif
