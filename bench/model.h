/* model.h - the engine's cost model beside measurements: of each program a plan in rows, one in
 * strips, and the one that the model prefers.
 *
 *     struct model_result results[MODEL_FORMS];
 *     for (int i = 0; i < model_programs_count(); i++)
 *         if (!model_measure(i, 1024, 1024, 5, results))
 *             ...bench_error()
 *
 * Every form runs on a machine of its own (it is paris_machine() afterwards); plans are for one
 * step, looked at after each. */
#ifndef LUTETIA_BENCH_MODEL_H
#define LUTETIA_BENCH_MODEL_H

#include "harness.h"

enum model_form { MODEL_ROWS, MODEL_STRIPS, MODEL_CHOSEN, MODEL_FORMS };

/* Of a cell and step, in ns; processor: the time of all threads, shared by as many as the
 * device has. */
struct model_result {
    struct bench_sample wall, processor;
    double predicted;
    bool in_strips; /* it is, or in tiles: not every program can be */
};

int model_programs_count(void);
const char *model_program_name(int program);
/* Shape: of the sheet, in cells, 64 or more each. The forms take turns, `rounds` of them.
 * Errors: false, bench_error(). */
bool model_measure(int program, int width, int height, int rounds,
                   struct model_result results[MODEL_FORMS]);

#endif
