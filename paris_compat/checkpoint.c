/* checkpoint.c - the machine to a file, and back.
 *
 *     "lutetia machine 1\n"
 *     numbers of 64 bits, the lowest byte first:
 *         processors, random seed and draws, next field's id and order, lenient, safety, current VP set, default VP set, field of the lights,
 *         geometries, VP sets, fields, bytes of the program's own memory
 *     the program's own memory
 *     each geometry     id, rank, then length, weight and ordering of each axis
 *     each VP set       id, geometry, context, test and overflow: a bit for each processor,
 *                       row-major, the lowest of a byte first
 *     each field        id, bits, ids that are its own, VP set, region, order, root, view,
 *                       parts
 *         each part     offset, bits, 1 if they are a float, 1 if all processors have the same;
 *                       one element or one for each
 *     SHA-256 of all that
 *
 * Roots of aliases come before these. A file is read twice: at first everything but the arrays
 * is looked at, and the sum; then the machine is emptied and filled. So a damaged file changes
 * nothing.
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <input_file.h>
#include <output_file.h>
#include <sha256.h>

#include "machine_inside.h"
#include "machine_saved.h"
#include "paris_saved.h"

static const char FIRST[] = "lutetia machine 1\n";
enum { FIRST_BYTES = sizeof FIRST - 1, PIECE = 1 << 16 };

/* ---- bytes ---- */

struct file {
    FILE *stream;
    struct sha256 sum;
    const char *wrong; /* NULL: nothing */
    bool reads;
};

static void pass(struct file *f, void *bytes, size_t count)
{
    if (f->wrong || !count)
        return;
    const bool good = f->reads ? fread(bytes, 1, count, f->stream) == count
                               : fwrite(bytes, 1, count, f->stream) == count;
    if (good)
        sha256_add(&f->sum, bytes, count);
    else
        f->wrong = f->reads ? "it ends too early" : output_file_explain(errno ? errno : EIO);
}

/* A number, written or read. */
static void number(struct file *f, uint64_t *n)
{
    uint8_t bytes[8];
    for (int i = 0; i < 8; i++)
        bytes[i] = (uint8_t)(*n >> 8 * i);
    pass(f, bytes, sizeof bytes);
    *n = 0;
    for (int i = 0; i < 8; i++)
        *n |= (uint64_t)bytes[i] << 8 * i;
}

/* A number that is read must be within bounds. */
static uint64_t within(struct file *f, uint64_t n, uint64_t least, uint64_t most)
{
    number(f, &n);
    if (!f->wrong && (n < least || n > most))
        f->wrong = "a number in it is out of range";
    return f->wrong ? least : n;
}

static void skip(struct file *f, uint64_t count)
{
    uint8_t bytes[4096];
    for (uint64_t n; count && !f->wrong; count -= n) {
        n = count < sizeof bytes ? count : sizeof bytes;
        pass(f, bytes, n);
    }
}

/* ---- what stands before the arrays ---- */

struct head {
    struct machine_saved_numbers numbers;
    uint64_t processors, lenient, safety, current, defaults, leds, geometries, sets, fields,
        own;
};

static void head_pass(struct file *f, struct head *h)
{
    char first[FIRST_BYTES];
    memcpy(first, FIRST, FIRST_BYTES);
    pass(f, first, FIRST_BYTES);
    if (!f->wrong && memcmp(first, FIRST, FIRST_BYTES) != 0)
        f->wrong = "it is no saved machine, or one of another version";
    h->processors = within(f, h->processors, 1, 1u << 30);
    number(f, &h->numbers.random_seed);
    number(f, &h->numbers.random_draws);
    h->numbers.next_field = within(f, h->numbers.next_field, 64, UINT32_MAX);
    number(f, &h->numbers.next_order);
    h->lenient = within(f, h->lenient, 0, 1);
    h->safety = within(f, h->safety, 0, 1);
    h->current = within(f, h->current, 1, UINT16_MAX);
    h->defaults = within(f, h->defaults, 0, UINT16_MAX);
    h->leds = within(f, h->leds, 0, UINT32_MAX);
    h->geometries = within(f, h->geometries, 0, 1u << 16);
    h->sets = within(f, h->sets, 1, UINT16_MAX);
    h->fields = within(f, h->fields, 0, 1u << 24);
    h->own = within(f, h->own, 0, UINT32_MAX);
}

static void geometry_pass(struct file *f, struct paris_saved_geometry *g)
{
    g->id = (int)within(f, (uint64_t)g->id, 1, 1u << 16);
    g->rank = (int)within(f, (uint64_t)g->rank, 1, MACHINE_AXES_MAX);
    uint64_t count = 1;
    for (int axis = 0; axis < g->rank && !f->wrong; axis++) {
        g->length[axis] = (int)within(f, (uint64_t)g->length[axis], 1, INT32_MAX);
        g->weight[axis] = (int)within(f, (uint64_t)(unsigned int)g->weight[axis], 0, INT32_MAX);
        g->ordering[axis] = (uint8_t)within(f, g->ordering[axis], 0, UINT8_MAX);
        count *= (uint64_t)g->length[axis];
        if (count > INT32_MAX)
            f->wrong = "it has more processors than there can be";
    }
    g->count = count;
}

static void field_pass(struct file *f, struct machine_saved_field *x)
{
    x->base = (uint32_t)within(f, x->base, 64, UINT32_MAX);
    x->bits = (uint32_t)within(f, x->bits, 0, UINT32_MAX);
    x->room = (uint32_t)within(f, x->room, 0, UINT32_MAX);
    x->vpset = (int)within(f, (uint64_t)x->vpset, 1, UINT16_MAX);
    x->region = within(f, x->region, 0, 1) ? MACHINE_HEAP : MACHINE_STACK;
    number(f, &x->order);
    x->root = (uint32_t)within(f, x->root, 0, UINT32_MAX);
    for (int i = 0; i < 4; i++)
        x->view[i] = (uint32_t)within(f, x->view[i], 0, UINT32_MAX);
    x->parts_count = (int)within(f, (uint64_t)x->parts_count, 0, x->root ? 0 : x->bits);
}

/* *next: where a part may begin. */
static void part_pass(struct file *f, const struct machine_saved_field *x,
                      struct machine_saved_part *p, uint32_t *next)
{
    p->offset = (uint32_t)within(f, p->offset, *next, x->bits);
    const uint64_t width = within(f, p->type.width, 1, 128);
    const bool is_float = within(f, p->type.kind == MACHINE_FLOAT, 0, 1);
    p->constant = within(f, p->constant, 0, 1);
    if (!f->wrong && (width > x->bits - p->offset || (is_float && width != 32 && width != 64)))
        f->wrong = "a part of a field in it is none";
    p->type = !is_float ? MACHINE_UINT(width) : width == 32 ? MACHINE_F32 : MACHINE_F64;
    *next = p->offset + (uint32_t)width;
    if (p->constant) {
        number(f, &p->number.lo);
        number(f, &p->number.hi);
    }
}

/* ---- to the file ---- */

static void flags_write(struct file *f, struct machine *m, int set, uint64_t count)
{
    uint8_t *bits = malloc(count);
    for (int flag = 0; flag < 3 && !f->wrong; flag++) {
        if (!bits || machine_flag_download(m, set, (enum machine_flag)flag, bits)) {
            f->wrong = bits ? machine_error(m) : "not enough memory";
            break;
        }
        for (uint64_t i = 0; i < count; i += 8) {
            uint8_t byte = 0;
            for (uint64_t k = i; k < count && k < i + 8; k++)
                byte |= (uint8_t)(bits[k] << (k - i));
            bits[i / 8] = byte;
        }
        pass(f, bits, (count + 7) / 8);
    }
    free(bits);
}

static void field_write(struct file *f, struct machine *m, struct machine_saved_field *x)
{
    const uint64_t count = machine_vpset_count(m, x->vpset);
    uint32_t next = 0;
    field_pass(f, x);
    for (int k = 0; k < x->parts_count && !f->wrong; k++) {
        struct machine_saved_part p;
        machine_begin(m);
        if (!machine_part_saved(m, x->base, k, &p)) {
            f->wrong = "a field has changed meanwhile";
            return;
        }
        part_pass(f, x, &p, &next);
        const size_t bytes = count * machine_element_bytes(p.type);
        void *array = p.constant ? NULL : malloc(bytes);
        if (!p.constant && !array)
            f->wrong = "not enough memory";
        else if (!p.constant &&
                 machine_field_download(m, x->base + p.offset, p.type, array) != MACHINE_OK)
            f->wrong = machine_error(m);
        if (array)
            pass(f, array, bytes);
        free(array);
    }
}

static void fields_write(struct file *f, struct machine *m, bool aliases)
{
    struct machine_saved_field x;
    for (int i = 0; !f->wrong; i++) {
        machine_begin(m);
        if (!machine_field_saved(m, i, &x)) {
            struct machine_field_info info;
            if (machine_field_at(m, i, &info))
                f->wrong = machine_error(m);
            return;
        }
        if ((x.root != 0) == aliases)
            field_write(f, m, &x);
    }
}

static void machine_write(struct file *f, struct machine *m, const void *own,
                          uint64_t own_bytes)
{
    struct machine_field_info info;
    struct paris_saved_geometry g;
    struct head h = {.processors = (uint64_t)machine_processors_count(m),
                     .lenient = machine_lenient(m),
                     .safety = paris_the.safety,
                     .current = (uint64_t)CM_current_vp_set,
                     .defaults = (uint64_t)paris_set_default(),
                     .leds = paris_the.leds,
                     .own = own_bytes};
    machine_numbers_saved(m, &h.numbers);
    while (machine_field_at(m, (int)h.fields, &info))
        h.fields++;
    for (int id = 1; id <= paris_the.geometries_count; id++)
        h.geometries += paris_geometry_find(id) != NULL;
    for (int set = 1; set < paris_the.sets_count; set++)
        h.sets += paris_set_valid(set);
    head_pass(f, &h);
    void *bytes = (void *)(uintptr_t)own; /* written, not changed */
    pass(f, bytes, own_bytes);
    for (int id = 1; id <= paris_the.geometries_count; id++)
        if (paris_geometry_saved(id, &g))
            geometry_pass(f, &g);
    for (int set = 1; set < paris_the.sets_count; set++)
        if (paris_set_valid(set)) {
            within(f, (uint64_t)set, 1, UINT16_MAX);
            within(f, (uint64_t)paris_the.set_geometry[set], 1, UINT32_MAX);
            flags_write(f, m, set, machine_vpset_count(m, set));
        }
    fields_write(f, m, false);
    fields_write(f, m, true);
}

unsigned int CM_checkpoint(const char *file_name, const void *own, unsigned long own_bytes)
{
    struct machine *m = paris_begin("CM_checkpoint");
    struct output_file out;
    uint8_t digest[SHA256_BYTES];
    if (!file_name || (own_bytes && !own) || own_bytes > UINT32_MAX) {
        paris_fail(file_name ? "own: must be memory of up to 2^32 - 1 bytes"
                             : "file_name: is NULL");
        return 0;
    }
    if (!output_file_open(&out, file_name)) {
        paris_fail("%.300s: cannot write: %s", file_name, out.why);
        return 0;
    }
    struct file f = {.stream = out.stream};
    sha256_begin(&f.sum);
    machine_flush(m);
    machine_write(&f, m, own, own_bytes);
    sha256_end(&f.sum, digest);
    if (!f.wrong && fwrite(digest, 1, sizeof digest, f.stream) != sizeof digest)
        f.wrong = output_file_explain(errno ? errno : EIO);
    if (f.wrong)
        output_file_abandon(&out);
    else if (!output_file_commit(&out))
        f.wrong = out.why;
    if (f.wrong)
        paris_fail("%.300s: cannot write: %s", file_name, f.wrong);
    machine_error_clear(m);
    return !f.wrong;
}

/* ---- from the file ---- */

/* All of it but arrays. */
struct saved {
    struct head head;
    struct paris_saved_geometry *geometries;
    struct paris_saved_set *sets;
    struct machine_saved_field field; /* the one under way */
};

static const struct paris_saved_geometry *geometry_of(const struct saved *s, int id)
{
    for (uint64_t i = 0; i < s->head.geometries; i++)
        if (s->geometries[i].id == id)
            return &s->geometries[i];
    return NULL;
}

/* The processors of a set; 0: there is none. */
static uint64_t count_of(const struct saved *s, int set)
{
    uint64_t low = 0, high = s->head.sets;
    while (low < high) {
        const uint64_t middle = (low + high) / 2;
        if (s->sets[middle].id == set)
            return s->sets[middle].count;
        if (s->sets[middle].id < set)
            low = middle + 1;
        else
            high = middle;
    }
    return 0;
}

static void geometries_read(struct file *f, struct saved *s)
{
    int last = 0;
    for (uint64_t i = 0; i < s->head.geometries && !f->wrong; i++) {
        geometry_pass(f, &s->geometries[i]);
        if (!f->wrong && s->geometries[i].id <= last)
            f->wrong = "its geometries are in no order";
        last = s->geometries[i].id;
    }
}

/* flags: also what the flags hold, into the machine. */
static void set_read(struct file *f, struct saved *s, uint64_t i, struct machine *flags)
{
    struct paris_saved_set *set = &s->sets[i];
    set->id =
        (int)within(f, (uint64_t)set->id, i ? (uint64_t)s->sets[i - 1].id + 1 : 1, UINT16_MAX);
    set->geometry = (int)within(f, (uint64_t)set->geometry, 1, 1u << 16);
    const struct paris_saved_geometry *g = f->wrong ? NULL : geometry_of(s, set->geometry);
    if (!g) {
        f->wrong = f->wrong ? f->wrong : "a VP set in it has no geometry";
        return;
    }
    set->count = g->count;
    if (!flags) {
        skip(f, 3 * ((g->count + 7) / 8));
        return;
    }
    uint8_t *packed = malloc((g->count + 7) / 8), *bits = malloc(g->count);
    for (int flag = 0; flag < 3 && !f->wrong; flag++) {
        if (!packed || !bits) {
            f->wrong = "not enough memory";
            break;
        }
        pass(f, packed, (g->count + 7) / 8);
        for (uint64_t k = 0; k < g->count; k++)
            bits[k] = packed[k / 8] >> k % 8 & 1;
        if (!f->wrong && machine_flag_upload(flags, set->id, (enum machine_flag)flag, bits))
            f->wrong = machine_error(flags);
    }
    free(packed);
    free(bits);
}

static void field_read(struct file *f, struct saved *s, struct machine *into)
{
    struct machine_saved_field *x = &s->field;
    uint32_t next = 0;
    field_pass(f, x);
    const uint64_t count = f->wrong ? 0 : count_of(s, x->vpset);
    if (!f->wrong && !count)
        f->wrong = "a field in it is of no VP set";
    if (into && !f->wrong && machine_field_restore(into, x) != MACHINE_OK)
        f->wrong = machine_error(into);
    for (int k = 0; k < x->parts_count && !f->wrong; k++) {
        struct machine_saved_part p = {.offset = 0};
        part_pass(f, x, &p, &next);
        if (f->wrong || p.constant || !into) {
            if (!f->wrong && !p.constant)
                skip(f, count * machine_element_bytes(p.type));
            if (!f->wrong && into && machine_part_restore(into, x->base, &p, NULL))
                f->wrong = machine_error(into);
            continue;
        }
        const size_t bytes = count * machine_element_bytes(p.type);
        void *array = malloc(bytes);
        if (!array)
            f->wrong = "not enough memory";
        pass(f, array, array ? bytes : 0);
        if (!f->wrong && machine_part_restore(into, x->base, &p, array) != MACHINE_OK)
            f->wrong = machine_error(into);
        free(array);
    }
}

/* All of the file; into NULL: only to look at it. own NULL: likewise. */
static void all_read(struct file *f, struct saved *s, struct machine *into, void *own)
{
    uint8_t digest[SHA256_BYTES], said[SHA256_BYTES];
    struct head h = {.processors = 0};
    f->reads = true;
    rewind(f->stream);
    sha256_begin(&f->sum);
    head_pass(f, &h);
    if (!f->wrong && !into) {
        s->head = h;
        s->geometries = calloc(h.geometries + 1, sizeof *s->geometries);
        s->sets = calloc(h.sets + 1, sizeof *s->sets);
        if (!s->geometries || !s->sets)
            f->wrong = "not enough memory";
    }
    if (!f->wrong && into && memcmp(&h, &s->head, sizeof h) != 0)
        f->wrong = "it has changed while it was read";
    if (own && !f->wrong)
        pass(f, own, h.own);
    else
        skip(f, h.own);
    if (!f->wrong)
        geometries_read(f, s);
    for (uint64_t i = 0; i < h.sets && !f->wrong; i++)
        set_read(f, s, i, into);
    for (uint64_t i = 0; i < h.fields && !f->wrong; i++)
        field_read(f, s, into);
    sha256_end(&f->sum, digest);
    if (!f->wrong && (fread(said, 1, sizeof said, f->stream) != sizeof said ||
                      memcmp(said, digest, sizeof said) != 0 || fgetc(f->stream) != EOF))
        f->wrong = "it is damaged: its sum is another";
    if (!f->wrong && (!count_of(s, (int)h.current) || (h.processors & (h.processors - 1))))
        f->wrong = "a number in it is out of range";
}

/* The machine anew, as the file has it. */
static void machine_read(struct file *f, struct saved *s, void *own)
{
    if (!paris_reset_to((unsigned int)s->head.processors)) {
        f->wrong = paris_error();
        return;
    }
    struct machine *m = paris_the.machine;
    if (!paris_sets_restore(s->geometries, s->head.geometries, s->sets, s->head.sets,
                            (int)s->head.defaults)) {
        f->wrong = paris_error();
        return;
    }
    machine_lenient_set(m, false); /* whose fields have more ids */
    all_read(f, s, m, own);
    if (!f->wrong && machine_numbers_restore(m, &s->head.numbers) != MACHINE_OK)
        f->wrong = machine_error(m);
    if (f->wrong)
        return;
    struct machine_field_info info;
    paris_the.leds =
        machine_field_lookup(m, (uint32_t)s->head.leds, &info) ? info.base : CM_no_field;
    paris_the.lenient = s->head.lenient;
    machine_lenient_set(m, paris_the.lenient);
    paris_the.safety = (unsigned int)s->head.safety;
    paris_the.pristine = false;
    paris_set_select((int)s->head.current);
}

unsigned int CM_resume(const char *file_name, void *own, unsigned long own_bytes)
{
    static char wrong[600];
    const char *why;
    struct saved s = {.geometries = NULL};
    paris_begin("CM_resume");
    if (!file_name || (own_bytes && !own)) {
        paris_fail(file_name ? "own: is NULL" : "file_name: is NULL");
        return 0;
    }
    struct file f = {.stream = input_file_open(file_name, &why)};
    if (!f.stream && errno == ENOENT)
        return 0;
    if (!f.stream) {
        paris_fail("%.300s: cannot read: %s", file_name, why);
        return 0;
    }
    all_read(&f, &s, NULL, NULL);
    if (!f.wrong && s.head.own != own_bytes) {
        snprintf(wrong, sizeof wrong, "own: the program saved %llu bytes, and wants %lu",
                 (unsigned long long)s.head.own, own_bytes);
        f.wrong = wrong;
    }
    const bool looked = !f.wrong;
    if (looked)
        machine_read(&f, &s, own);
    fclose(f.stream);
    free(s.geometries);
    free(s.sets);
    if (f.wrong) {
        if (f.wrong != wrong)
            snprintf(wrong, sizeof wrong, "%s", f.wrong);
        if (looked)
            paris_reset(NULL);
        paris_the.call = "CM_resume";
        paris_fail("%.300s: cannot resume: %s%s", file_name, wrong,
                   looked ? "; the machine is empty now" : "");
    }
    return !f.wrong;
}
