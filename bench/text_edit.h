/* text_edit.h - the second part of `lutetia bench text`: changes of a long text. */
#ifndef LUTETIA_BENCH_TEXT_EDIT_H
#define LUTETIA_BENCH_TEXT_EDIT_H

#include "harness.h"

#include <stdbool.h>
#include <stdint.h>

/* Adds its rows. False: bench_error() says why. */
bool bench_text_edit(struct bench_report *report, const char *const *words,
                     uint32_t words_count);

#endif
