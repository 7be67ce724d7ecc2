/* text.h - text that grows. */
#ifndef LUTETIA_MACHINE_TEXT_H
#define LUTETIA_MACHINE_TEXT_H

#include "machine.h"

struct text {
    char *data;
    size_t length, capacity;
    bool failed;
};

__attribute__((format(printf, 2, 3))) void text_put(struct text *t, const char *format, ...);
bool text_same(const struct text *a, const struct text *b);
/* As the prelude calls a type in memory. */
const char *memory_kind(struct machine_type t);
const char *memory_type(struct machine_type t);

#endif
