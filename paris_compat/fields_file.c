/* fields_file.c - fields to and from files of today: <lutetia/fields.h>. */
#include "field_bytes.h"
#include "h5.h"

#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif
#include <lutetia/fields.h>
#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#include <input_file.h>
#include <output_file.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum format { FORMAT_NONE, FORMAT_NPY, FORMAT_RAW, FORMAT_H5 };

/* What a call transfers. */
struct transfer {
    const char *file;
    char path[4096], name[H5_NAME_MAX + 1]; /* of FORMAT_H5: FILE:NAME */
    enum format format;
    struct machine *m;
    CM_field_id_t field;
    char kind;
    unsigned int bytes, bits; /* of a value in the file; in the field */
    struct npy array;         /* of that kind, with the VP set's shape */
};

/* Takes a file's name apart. */
static enum format format_of(struct transfer *t, const char *file)
{
    static const struct {
        const char *ending;
        enum format format;
    } formats[] = {{".npy", FORMAT_NPY},
                   {".raw", FORMAT_RAW},
                   {".bin", FORMAT_RAW},
                   {".h5", FORMAT_H5},
                   {".hdf5", FORMAT_H5}};
    t->file = file;
    if (!file || strlen(file) >= sizeof t->path)
        return FORMAT_NONE;
    snprintf(t->path, sizeof t->path, "%s", file);
    char *dot = strrchr(t->path, '.'), *colon = dot ? strchr(dot, ':') : NULL;
    if (colon) {
        if (strlen(colon + 1) > H5_NAME_MAX || !colon[1] || strchr(colon + 1, '/'))
            return FORMAT_NONE;
        snprintf(t->name, sizeof t->name, "%.*s", H5_NAME_MAX, colon + 1);
        *colon = '\0';
    }
    for (size_t i = 0; dot && i < sizeof formats / sizeof *formats; i++)
        if (strcmp(dot, formats[i].ending) == 0 && (!colon || formats[i].format == FORMAT_H5))
            return formats[i].format;
    return FORMAT_NONE;
}

static bool type_good(struct transfer *t, const char *type, unsigned int len)
{
    static const char *const types[] = {"b1", "u1", "u2", "u4", "u8", "i1",  "i2",
                                        "i4", "i8", "f4", "f8", "c8", "c16", NULL};
    int i = 0;
    while (types[i] && (!type || strcmp(types[i], type) != 0))
        i++;
    if (!types[i]) {
        paris_fail("type: must be one of u1 u2 u4 u8 i1 i2 i4 i8 f4 f8 c8 c16 b1 (got %.20s)",
                   type ? type : "NULL");
        return false;
    }
    t->kind = type[0];
    t->bytes = (unsigned int)atoi(type + 1);
    const unsigned int all = t->kind == 'b' ? 1 : 8 * t->bytes;
    t->bits = len ? len : all;
    if (t->bits > all || (t->bits < all && t->kind != 'u' && t->kind != 'i') ||
        (t->kind == 'i' && t->bits < 2)) {
        paris_fail("len: a field for %s has %s%u bits (got %u)", type,
                   t->kind == 'i'   ? "2.."
                   : t->kind == 'u' ? "1.."
                                    : "",
                   all, t->bits);
        return false;
    }
    return true;
}

static bool transfer_begin(struct transfer *t, const char *name, const char *file,
                           CM_field_id_t field, const char *type, unsigned int len)
{
    *t = (struct transfer){.m = paris_begin(name), .field = field};
    t->format = format_of(t, file);
    if (t->format == FORMAT_NONE) {
        paris_fail("file: %.200s: the name must end in .npy, .raw, .bin, .h5 or .h5:NAME",
                   file ? file : "NULL");
        return false;
    }
    if (!type_good(t, type, len) || !paris_check_field_wholly(field, t->bits, "field"))
        return false;
    if (t->format == FORMAT_H5 && t->kind == 'c') {
        paris_fail("type: %s: complex numbers go to .npy and .raw", type);
        return false;
    }
    const int set = machine_vpset_current(t->m);
    t->array = (struct npy){.kind = t->kind == 'b' && t->format == FORMAT_H5 ? 'u' : t->kind,
                            .bytes = t->bytes,
                            .rank = machine_vpset_rank(t->m, set)};
    for (int i = 0; i < t->array.rank; i++)
        t->array.shape[i] = (uint64_t)machine_vpset_length(t->m, set, i);
    return true;
}

static bool bytes_begin(const struct transfer *t, struct field_bytes *b)
{
    const struct machine_type type = t->bytes == 4 ? MACHINE_F32 : MACHINE_F64;
    return field_bytes_begin(b, t->m, t->field, t->bits, t->bytes,
                             t->kind == 'f' ? &type : NULL, t->kind == 'i');
}

/* ---- writing ---- */

static void head_write(const struct transfer *t, FILE *out)
{
    char head[NPY_HEAD_MAX];
    uint8_t h5[H5_HEAD];
    if (t->format == FORMAT_NPY)
        fwrite(head, 1, npy_make(&t->array, head), out);
    if (t->format != FORMAT_H5)
        return;
    h5_make(&t->array, *t->name ? t->name : "field", h5);
    fwrite(h5, 1, sizeof h5, out);
}

int lutetia_field_write(const char *file, CM_field_id_t field, const char *type,
                        unsigned int len)
{
    struct transfer t;
    struct field_bytes b;
    struct output_file out;
    if (!transfer_begin(&t, "lutetia_field_write", file, field, type, len))
        return 0;
    if (!output_file_open(&out, t.path)) {
        paris_fail("%.200s: cannot write: %s", file, out.why);
        return 0;
    }
    if (!bytes_begin(&t, &b)) {
        output_file_abandon(&out);
        return 0;
    }
    bool read = true;
    head_write(&t, out.stream);
    while (read && !ferror(out.stream) && field_bytes_next(&b)) {
        read = field_bytes_get(&b);
        if (read)
            fwrite(b.bytes, 1, b.count, out.stream);
    }
    field_bytes_end(&b);
    if (!read) {
        output_file_abandon(&out);
        return 0;
    }
    if (output_file_commit(&out))
        return 1;
    paris_fail("%.200s: cannot write: %s", file, out.why);
    return 0;
}

/* ---- reading ---- */

static bool wrong(const struct transfer *t, const char *why)
{
    paris_fail("%.200s: %s", t->file, why);
    return false;
}

/* Reads the head of a .npy file, up to the values. False: said. */
static bool npy_head_read(FILE *in, const char *file, struct npy *npy)
{
    uint8_t *head = calloc(1, NPY_HEAD_MAX + NPY_BEGIN);
    const char *why = "it is no .npy file";
    if (!head) {
        paris_fail_memory("not enough memory to read %.200s", file);
        return false;
    }
    if (fread(head, 1, NPY_BEGIN, in) == NPY_BEGIN) {
        const size_t length = npy_head_length(head);
        const size_t rest = length > NPY_BEGIN ? length - NPY_BEGIN : 0;
        if (length >= NPY_BEGIN && fread(head + NPY_BEGIN, 1, rest, in) == rest)
            why = npy_read(head, length, npy);
    }
    free(head);
    if (why)
        paris_fail("%.200s: %s", file, why);
    return !why;
}

/* The array that the file has; nothing of a raw one. False: said. */
static bool head_read(const struct transfer *t, FILE *in, struct npy *npy)
{
    const char *why = NULL;
    if (t->format == FORMAT_NPY)
        return npy_head_read(in, t->file, npy);
    if (t->format == FORMAT_H5)
        why = h5_read(in, t->name, npy);
    if (why)
        paris_fail("%.200s: %s", t->file, why);
    return !why;
}

static void shape_text(const struct npy *npy, char *out, size_t room)
{
    size_t n = 0;
    *out = '\0';
    for (int i = 0; i < npy->rank && n < room; i++)
        n += (size_t)snprintf(out + n, room - n, "%s%llu", i ? "x" : "",
                              (unsigned long long)npy->shape[i]);
}

static bool head_good(const struct transfer *t, const struct npy *npy)
{
    if (npy->kind != t->array.kind || npy->bytes != t->bytes) {
        paris_fail("%.200s: its elements are %c%u, not %c%u", t->file, npy->kind, npy->bytes,
                   t->array.kind, t->bytes);
        return false;
    }
    if (npy->fortran && npy->rank > 1)
        return wrong(t,
                     "its array is in Fortran's order: numpy.ascontiguousarray() makes it C's");
    if (npy->rank != t->array.rank ||
        memcmp(npy->shape, t->array.shape, sizeof *npy->shape * (size_t)npy->rank) != 0) {
        char theirs[400], ours[400];
        shape_text(npy, theirs, sizeof theirs);
        shape_text(&t->array, ours, sizeof ours);
        paris_fail("%.100s: its shape is %.100s, the VP set's is %.100s", t->file, theirs,
                   ours);
        return false;
    }
    return true;
}

static bool size_good(const struct transfer *t, FILE *in, uint64_t head, uint64_t values)
{
    struct stat status;
    if (fstat(fileno(in), &status) != 0)
        return wrong(t, strerror(errno));
    if ((uint64_t)status.st_size == head + values ||
        (t->format == FORMAT_H5 && (uint64_t)status.st_size > head + values))
        return fseek(in, (long)head, SEEK_SET) == 0;
    paris_fail("%.200s: has %lld bytes, and the VP set's values take %llu", t->file,
               (long long)status.st_size, (unsigned long long)(head + values));
    return false;
}

/* Turns the numbers of big-endian values round. */
static void bytes_turn(struct field_bytes *b, size_t each)
{
    for (uint8_t *at = b->bytes; at < b->bytes + b->count; at += each)
        for (size_t i = 0; i < each / 2; i++) {
            const uint8_t kept = at[i];
            at[i] = at[each - 1 - i];
            at[each - 1 - i] = kept;
        }
}

static bool band_read(const struct transfer *t, struct field_bytes *b, FILE *in,
                      const struct npy *npy)
{
    if (fread(b->bytes, 1, b->count, in) != b->count)
        return wrong(t, "cannot be read to its end");
    if (npy->swapped)
        bytes_turn(b, t->kind == 'c' ? t->bytes / 2 : t->bytes);
    return true;
}

/* Whether all values fit, before one is stored. */
static bool values_fit(const struct transfer *t, FILE *in, const struct npy *npy)
{
    struct field_bytes b;
    bool good = true;
    if (t->bits == 8 * t->bytes)
        return true;
    if (!bytes_begin(t, &b))
        return false;
    while (good && field_bytes_next(&b)) {
        good = band_read(t, &b, in, npy);
        if (good && !field_bytes_fit(&b)) {
            paris_fail("%.200s: a value does not fit into the field's %u bits", t->file,
                       t->bits);
            good = false;
        }
    }
    field_bytes_end(&b);
    return good && fseek(in, (long)npy->head, SEEK_SET) == 0;
}

static bool values_read(const struct transfer *t, FILE *in)
{
    struct npy npy = {0};
    struct field_bytes b;
    if (t->format != FORMAT_RAW && (!head_read(t, in, &npy) || !head_good(t, &npy)))
        return false;
    if (!bytes_begin(t, &b))
        return false;
    bool good = size_good(t, in, npy.head, field_bytes_all(&b)) && values_fit(t, in, &npy);
    while (good && field_bytes_next(&b))
        good = band_read(t, &b, in, &npy) && field_bytes_put(&b);
    field_bytes_end(&b);
    return good;
}

int lutetia_field_read(const char *file, CM_field_id_t field, const char *type,
                       unsigned int len)
{
    struct transfer t;
    const char *why;
    if (!transfer_begin(&t, "lutetia_field_read", file, field, type, len))
        return 0;
    FILE *in = input_file_open(t.path, &why);
    if (!in)
        return wrong(&t, why);
    const bool good = values_read(&t, in);
    fclose(in);
    return good;
}

int lutetia_file_shape(const char *file, unsigned int *lengths, int most)
{
    struct transfer t = {0};
    struct npy npy;
    const char *why;
    paris_inquire("lutetia_file_shape");
    t.format = format_of(&t, file);
    if (t.format != FORMAT_NPY && t.format != FORMAT_H5) {
        paris_fail("file: %.200s: only .npy and .h5 files tell their shape",
                   file ? file : "NULL");
        return -1;
    }
    FILE *in = input_file_open(t.path, &why);
    if (!in) {
        paris_fail("%.200s: %s", file, why);
        return -1;
    }
    const bool good = head_read(&t, in, &npy);
    fclose(in);
    for (int i = 0; good && lengths && i < npy.rank && i < most; i++)
        lengths[i] = (unsigned int)npy.shape[i];
    return good ? npy.rank : -1;
}
