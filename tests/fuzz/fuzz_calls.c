/* fuzz_calls.c - makes C/Paris calls from bytes; most calls are nearly right.
 *
 * libFuzzer and seeds.c call LLVMFuzzerTestOneInput(). The first byte of input is the mode. Its
 * bit 0 is the safety mode. 0xfe and 0xff also allow calls that build and run kernels; these
 * values are rare, because kernels take long. A call is two bytes for its row of the table and
 * the bytes of its arguments. There are at most CALLS_MAX calls. A wrong call must give one
 * line that begins with its name; the host must not be harmed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "paris_internal.h"
#include <cm/paris.h>

#include "fuzz_calls.h"

enum {
    FIELDS = 16,
    IDS = 8,
    CALLS_MAX = 64,
    VECTOR = 32,
    ARRAY_BYTES = 1 << 16,
    VPS_MAX = 4096
};

struct fuzz {
    const uint8_t *at, *end;
    CM_field_id_t fields[FIELDS]; /* some may be deallocated, as in wrong programs */
    CM_vp_set_id_t sets[IDS];
    CM_geometry_id_t geometries[IDS];
    unsigned int kept;        /* how many ids, of all kinds */
    unsigned int significand; /* s of the pair s, e that is being drawn */
};

struct fuzz_row {
    const char *name;
    void (*call)(struct fuzz *f);
    int observes;
};

static const char *call_now;

static void wrong(const char *message)
{
    size_t length = strlen(call_now);
    if (strncmp(message, call_now, length) != 0 || message[length] != ':' ||
        strchr(message, '\n')) {
        fprintf(stderr, "%s says: %s\n", call_now, message);
        abort();
    }
}

/* ---- arguments ---- */

static unsigned int byte(struct fuzz *f)
{
    return f->at < f->end ? *f->at++ : 0;
}

static unsigned int word32(struct fuzz *f)
{
    unsigned int x = byte(f);
    x = x << 8 | byte(f);
    x = x << 8 | byte(f);
    return x << 8 | byte(f);
}

/* Draws a number that is wrong for nearly every argument. */
static unsigned int wild(struct fuzz *f)
{
    static const unsigned int numbers[] = {
        0,   1,  0x7fffffffu, 0x80000000u, 0xffffffffu, 0xfffffffeu, 129,  128,
        127, 65, 64,          63,          0x7fff0000u, 0xffffffc0u, 4096, 0x10000u};
    unsigned int which = byte(f);
    return which < 16 ? numbers[which] : which < 32 ? word32(f) : which;
}

static CM_field_id_t fuzz_field(struct fuzz *f)
{
    unsigned int x = byte(f);
    if (x >= 250)
        return wild(f);
    if (x >= 245)
        return CM_no_field;
    CM_field_id_t field = f->fields[x % FIELDS];
    return x < 160 ? field : field + (x < 200 ? 8 * (x % 16) : byte(f) - 64u);
}

static unsigned int fuzz_length(struct fuzz *f)
{
    static const uint8_t usual[] = {1, 2, 3, 7, 8, 9, 15, 16, 17, 24, 31, 32, 33, 48, 63, 64};
    unsigned int x = byte(f);
    return x >= 250 ? wild(f) : x >= 200 ? x - 160 : x >= 100 ? 32 : usual[x % 16];
}

static unsigned int fuzz_significand(struct fuzz *f)
{
    unsigned int x = byte(f);
    f->significand = x >= 240 ? wild(f) : x >= 200 ? x % 54 : x >= 120 ? 52 : 23;
    return f->significand;
}

static unsigned int fuzz_exponent(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 250 ? wild(f) : x >= 235 ? x % 13 : f->significand == 52 ? 11 : 8;
}

static unsigned int fuzz_small(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 250 ? wild(f) : x % 8;
}

static unsigned int fuzz_axis(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 250 ? wild(f) : x >= 200 ? x % 4 : x % 2;
}

static unsigned int fuzz_rank(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 250 ? wild(f) : x >= 240 ? 28 + x % 6 : 1 + x % 3;
}

static unsigned int fuzz_number(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 200 ? wild(f) : x % 32;
}

static int fuzz_offset(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 250 ? (int)wild(f) : (int)x - 32;
}

static unsigned int fuzz_address(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 240 ? wild(f) : x % 24;
}

static unsigned long fuzz_word(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 240 ? (unsigned long)word32(f) << 32 | word32(f) : x >= 220 ? ~0ul : x;
}

static double fuzz_double(struct fuzz *f)
{
    uint64_t bits = (uint64_t)word32(f) << 32 | word32(f);
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static CM_vp_set_id_t fuzz_vp_set(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 240 ? (int)wild(f) : f->sets[x % IDS];
}

static CM_geometry_id_t fuzz_geometry(struct fuzz *f)
{
    unsigned int x = byte(f);
    return x >= 240 ? (int)wild(f) : f->geometries[x % IDS];
}

/* Returns the next of several arrays, because a call has several vectors at once. */
static int *vector_next(void)
{
    static int vectors[16][VECTOR];
    static unsigned int turn;
    return vectors[turn++ % 16];
}

static CM_vector_t fuzz_vector(struct fuzz *f)
{
    unsigned int x = byte(f);
    int *v = vector_next();
    for (int i = 0; i < VECTOR; i++)
        v[i] = x % 4 == 0 ? i : i < 4 ? (int)(byte(f) % 6) - (x % 4 == 3) : 0;
    if (x >= 245)
        v[x % 3] = (int)wild(f);
    return (CM_vector_t){.ints = x == 244 ? NULL : v};
}

/* Draws lengths. They may be those of the fuzzer's own array, so they never exceed it. */
static CM_vector_t fuzz_dimensions(struct fuzz *f)
{
    unsigned int x = byte(f);
    int *v = vector_next();
    for (int i = 0; i < VECTOR; i++)
        v[i] = i < 3 ? 1 + (int)(byte(f) % 8) : 1;
    if (x >= 240)
        v[x % 3] = x % 2 ? 0 : x % 4 ? -1 : -2147483647 - 1;
    return (CM_vector_t){.ints = x == 239 ? NULL : v};
}

static CM_axis_descriptor_t *fuzz_descriptors(struct fuzz *f)
{
    static struct CM_axis_descriptor axes[VECTOR];
    static CM_axis_descriptor_t pointers[VECTOR];
    unsigned int x = byte(f);
    for (int i = 0; i < VECTOR; i++) {
        axes[i] = (struct CM_axis_descriptor){.length = i < 3 ? 1 + byte(f) % 8 : 1,
                                              .weight = 1,
                                              .ordering = i < 3 ? (int)(byte(f) / 96) : 0};
        pointers[i] = &axes[i];
    }
    if (x >= 250)
        axes[x % 3].length = wild(f);
    if (x == 249)
        pointers[1] = NULL;
    return x == 248 ? NULL : pointers;
}

static void *fuzz_array(struct fuzz *f)
{
    static uint64_t array[ARRAY_BYTES / 8];
    return byte(f) == 255 ? NULL : array;
}

static void fuzz_keep_field_id(struct fuzz *f, CM_field_id_t field)
{
    if (field != CM_no_field)
        f->fields[f->kept++ % FIELDS] = field;
}

static void fuzz_keep_vp_set_id(struct fuzz *f, CM_vp_set_id_t set)
{
    if (set)
        f->sets[f->kept++ % IDS] = set;
}

static void fuzz_keep_geometry_id(struct fuzz *f, CM_geometry_id_t geometry)
{
    if (!geometry)
        return;
    if (CM_geometry_total_processors(geometry) > VPS_MAX) { /* right, and too big for here */
        CM_deallocate_geometry(geometry);
        return;
    }
    f->geometries[f->kept++ % IDS] = geometry;
}

#include "paris_fuzz_table.h"

enum { ROWS = sizeof fuzz_rows / sizeof *fuzz_rows };

/* ---- a sequence ---- */

static void begin(struct fuzz *f)
{
    int dimensions[2] = {3, 5};
    CM_init();
    f->geometries[0] = CM_current_geometry;
    f->sets[0] = CM_current_vp_set;
    f->geometries[1] = CM_create_geometry((CM_vector_t){.ints = dimensions}, 2);
    f->sets[1] = CM_allocate_vp_set(f->geometries[1]);
    for (int i = 2; i < IDS; i++) {
        f->geometries[i] = f->geometries[i % 2];
        f->sets[i] = f->sets[i % 2];
    }
    CM_set_vp_set(f->sets[1]);
    for (int i = 0; i < FIELDS; i++)
        f->fields[i] = i % 4 == 3   ? f->fields[i - 2] + 32
                       : i % 3 == 2 ? CM_allocate_heap_field(128)
                                    : CM_allocate_stack_field(64);
    f->kept = 0;
    f->significand = 23;
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    unsetenv("LUTETIA_LEDS");
    setenv("LUTETIA_PROCESSORS", "4", 1);
    CM_set_error_handler(wrong);
    call_now = "CM_init";
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    struct fuzz f = {.at = bytes, .end = bytes + count};
    call_now = "none is wrong here";
    paris_safety_usual();
    begin(&f);
    unsigned int mode = byte(&f);
    if (mode & 2)
        CM_set_safety_mode(mode & 1); /* lenient, or safe */
    else if (mode & 1)
        CM_set_safety_mode(1);
    for (int i = 0; i < CALLS_MAX && f.at < f.end; i++) {
        unsigned int row = byte(&f) << 8;
        row = (row | byte(&f)) % ROWS;
        if (fuzz_rows[row].observes && mode < 0xfe)
            continue;
        call_now = fuzz_rows[row].name;
        fuzz_rows[row].call(&f);
    }
    return 0;
}
