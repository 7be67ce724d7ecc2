/* text.c - see text.h. */
#include "codegen/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void text_put(struct text *t, const char *format, ...)
{
    for (;;) {
        va_list arguments;
        va_start(arguments, format);
        size_t room = t->capacity - t->length;
        int n = t->data ? vsnprintf(t->data + t->length, room, format, arguments) : -1;
        va_end(arguments);
        if (t->data && n >= 0 && (size_t)n < room) {
            t->length += (size_t)n;
            return;
        }
        size_t capacity = t->capacity ? 2 * t->capacity : 8192;
        char *data = realloc(t->data, capacity);
        if (!data) {
            t->failed = true;
            return;
        }
        t->data = data;
        t->capacity = capacity;
    }
}

bool text_same(const struct text *a, const struct text *b)
{
    return a->length == b->length && (!a->length || !memcmp(a->data, b->data, a->length));
}

const char *memory_kind(struct machine_type t)
{
    if (t.kind == MACHINE_FLOAT)
        return t.width == 32 ? "f32" : "f64";
    return t.width == 1    ? "bit"
           : t.width <= 8  ? "u8"
           : t.width <= 16 ? "u16"
           : t.width <= 32 ? "u32"
           : t.width <= 64 ? "u64"
                           : "u128";
}

const char *memory_type(struct machine_type t)
{
    if (t.kind == MACHINE_FLOAT)
        return t.width == 32 ? "float" : "double";
    return t.width <= 8 ? "uchar" : t.width <= 16 ? "ushort" : t.width <= 32 ? "uint" : "ulong";
}
