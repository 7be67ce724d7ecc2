/* clamps_file.c - clamps as text: see clamps.h. */
#include "clamps.h"
#include "clamps_internal.h"
#include "reader.h"

#include <number_text.h>
#include <output_file.h>
#include <stdlib.h>

static enum dyn_status key_read(struct dyn_reader *r, void *clamps)
{
    static const char *const names[] = {"time", "x", "y"};
    double values[3] = {0};
    int mass = 0;
    enum dyn_status status = dyn_reader_mass(r, "mass", dyn_reader_word(r), &mass);
    for (int i = 0; i < 3 && status == DYN_OK; i++)
        status = dyn_reader_number(r, names[i], dyn_reader_word(r), &values[i]);
    if (status != DYN_OK)
        return status;
    status = dyn_clamps_key(clamps, mass, values[0], values[1], values[2]);
    return status == DYN_OK ? DYN_OK : dyn_reader_wrong(r, status);
}

static enum dyn_status free_read(struct dyn_reader *r, void *clamps)
{
    double time = 0;
    int mass = 0;
    enum dyn_status status = dyn_reader_mass(r, "mass", dyn_reader_word(r), &mass);
    if (status == DYN_OK)
        status = dyn_reader_number(r, "time", dyn_reader_word(r), &time);
    if (status != DYN_OK)
        return status;
    status = dyn_clamps_free(clamps, mass, time);
    return status == DYN_OK ? DYN_OK : dyn_reader_wrong(r, status);
}

enum dyn_status dyn_clamps_parse(const char *text, size_t bytes, const char *name,
                                 struct dyn_clamps **out)
{
    static const struct dyn_reader_line lines[] = {{"key", key_read}, {"free", free_read}};
    struct dyn_reader r = {.name = name};
    enum dyn_status status = dyn_clamps_create(out);
    if (status == DYN_OK)
        status = dyn_reader_run(&r, text, bytes, "clamps 1", lines, 2, *out);
    if (status != DYN_OK) {
        dyn_clamps_destroy(*out);
        *out = NULL;
    }
    return status;
}

enum dyn_status dyn_clamps_read(const char *path, struct dyn_clamps **out)
{
    char *text;
    size_t bytes = 0;
    *out = NULL;
    enum dyn_status status = dyn_file_bytes(path, &text, &bytes);
    if (status == DYN_OK)
        status = dyn_clamps_parse(text, bytes, path, out);
    free(text);
    return status;
}

enum dyn_status dyn_clamps_print(const struct dyn_clamps *c, FILE *to)
{
    struct number_text_locale locale;
    if (!number_text_begin(&locale))
        return dyn_fail(DYN_NO_MEMORY, "no memory for a locale");
    fputs("clamps 1\n", to);
    for (int i = 0; i < c->count; i++) {
        const struct dyn_key *k = &c->keys[i];
        fprintf(to, "%s %d ", k->free ? "free" : "key", k->mass);
        number_text_print(to, k->time_s);
        if (!k->free) {
            fputc(' ', to);
            number_text_print(to, k->x);
            fputc(' ', to);
            number_text_print(to, k->y);
        }
        fputc('\n', to);
    }
    fputs("end\n", to);
    number_text_end(&locale);
    return DYN_OK;
}

enum dyn_status dyn_clamps_write(const struct dyn_clamps *c, const char *path)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return dyn_fail(DYN_BAD_FILE, "%s: cannot write: %s", path, out.why);
    enum dyn_status status = dyn_clamps_print(c, out.stream);
    if (status != DYN_OK) {
        output_file_abandon(&out);
        return status;
    }
    if (!output_file_commit(&out))
        return dyn_fail(DYN_BAD_FILE, "%s: cannot write: %s", path, out.why);
    return DYN_OK;
}
