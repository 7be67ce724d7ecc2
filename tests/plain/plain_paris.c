/* plain_paris.c - the C/Paris calls that sheets use, as loops over arrays.
 *
 * It has two uses. Sheets must hold the same bits on it and on the machine. And it is fast on
 * tiny sheets, so that a test can run a million of them. One VP set at a time is current. A
 * field is an array of one word for each processor, or of two words where it is longer than 32
 * bits. The linker reports calls that are missing here. Random numbers are its own. */
#include <cm/paris.h>

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FIELDS_MAX = 4096, SETS_MAX = 64, GEOMETRIES_MAX = 64 };

struct set {
    bool used;
    int height, width, count;
    uint8_t *context, *test;
    bool all; /* the context is all ones */
};

static struct set sets[SETS_MAX];
static struct {
    bool used;
    int height, width;
} geometries[GEOMETRIES_MAX];
static struct {
    void *words; /* NULL: free */
    int set;
} fields[FIELDS_MAX];
static int current;
static uint64_t random_state;

static struct set *the(void)
{
    return &sets[current];
}

static float *floats(CM_field_id_t id)
{
    return fields[id].words;
}

static uint32_t *words(CM_field_id_t id)
{
    return fields[id].words;
}

static uint64_t *longs(CM_field_id_t id)
{
    return fields[id].words;
}

static double *doubles(CM_field_id_t id)
{
    return fields[id].words;
}

/* For every active processor i; the loop without a test of the context can be vectorised. */
#define EACH(statement)                                                                        \
    do {                                                                                       \
        const struct set *s_ = the();                                                          \
        const int count_ = s_->count;                                                          \
        if (s_->all) {                                                                         \
            for (int i = 0; i < count_; i++) {                                                 \
                statement;                                                                     \
            }                                                                                  \
        } else {                                                                               \
            for (int i = 0; i < count_; i++)                                                   \
                if (s_->context[i]) {                                                          \
                    statement;                                                                 \
                }                                                                              \
        }                                                                                      \
    } while (0)

/* ---- life ---- */

unsigned int CM_attach(void)
{
    return 1;
}

int CM_attached(void)
{
    return 1;
}

void CM_set_error_handler(void (*handler)(const char *message))
{
    (void)handler;
}

unsigned int CM_error_status(void)
{
    return CM_error_none;
}

void CM_warm_boot(void)
{
}

void CM_clear_overflow(void)
{
}

CM_geometry_id_t CM_create_geometry(CM_vector_t dimensions, unsigned int rank)
{
    int id = 1;
    while (geometries[id].used)
        if (++id == GEOMETRIES_MAX)
            abort();
    if (rank != 2)
        abort();
    geometries[id].used = true;
    geometries[id].height = dimensions.ints[0];
    geometries[id].width = dimensions.ints[1];
    return id;
}

void CM_deallocate_geometry(CM_geometry_id_t geometry)
{
    geometries[geometry].used = false;
}

CM_vp_set_id_t CM_allocate_vp_set(CM_geometry_id_t geometry)
{
    int id = 1;
    while (sets[id].used)
        if (++id == SETS_MAX)
            abort();
    int count = geometries[geometry].height * geometries[geometry].width;
    sets[id] = (struct set){.used = true,
                            .height = geometries[geometry].height,
                            .width = geometries[geometry].width,
                            .count = count,
                            .context = malloc((size_t)count),
                            .test = calloc((size_t)count, 1),
                            .all = true};
    memset(sets[id].context, 1, (size_t)count);
    return id;
}

void CM_deallocate_vp_set(CM_vp_set_id_t id)
{
    for (unsigned i = 1; i < FIELDS_MAX; i++)
        if (fields[i].words && fields[i].set == id)
            CM_deallocate_heap_field(i);
    free(sets[id].context);
    free(sets[id].test);
    sets[id].used = false;
}

void CM_set_vp_set(CM_vp_set_id_t id)
{
    current = id;
}

CM_field_id_t CM_allocate_heap_field(unsigned int len)
{
    static CM_field_id_t last = 0;
    for (int tries = 0; tries < FIELDS_MAX; tries++) {
        last = last % (FIELDS_MAX - 1) + 1;
        if (!fields[last].words) {
            fields[last].words = calloc((size_t)the()->count, len > 32 ? 8 : 4);
            fields[last].set = current;
            return last;
        }
    }
    abort();
}

void CM_deallocate_heap_field(CM_field_id_t id)
{
    free(fields[id].words);
    fields[id].words = NULL;
}

/* ---- contexts ---- */

void CM_set_context(void)
{
    if (!the()->all)
        memset(the()->context, 1, (size_t)the()->count);
    the()->all = true;
}

void CM_clear_context(void)
{
    memset(the()->context, 0, (size_t)the()->count);
    the()->all = false;
}

void CM_store_context(CM_field_id_t dest)
{
    for (int i = 0; i < the()->count; i++)
        words(dest)[i] = the()->context[i];
}

void CM_load_context(CM_field_id_t source)
{
    the()->all = false;
    for (int i = 0; i < the()->count; i++)
        the()->context[i] = (uint8_t)words(source)[i];
}

void CM_logand_context_with_test(void)
{
    the()->all = false;
    for (int i = 0; i < the()->count; i++)
        the()->context[i] &= the()->test[i];
}

#define TEST(name, type, condition)                                                            \
    void name(CM_field_id_t source, unsigned long value, unsigned int len)                     \
    {                                                                                          \
        (void)len;                                                                             \
        EACH(uint32_t x = words(source)[i]; the()->test[i] = condition);                       \
    }
TEST(CM_u_eq_constant_1L, uint32_t, x == value)
TEST(CM_u_ge_constant_1L, uint32_t, x >= value)
TEST(CM_u_lt_constant_1L, uint32_t, x < value)

void CM_f_gt_zero_1L(CM_field_id_t source, unsigned int s, unsigned int e)
{
    (void)s, (void)e;
    EACH(the()->test[i] = floats(source)[i] > 0);
}

void CM_f_lt_zero_1L(CM_field_id_t source, unsigned int s, unsigned int e)
{
    (void)s, (void)e;
    EACH(the()->test[i] = floats(source)[i] < 0);
}

/* ---- arithmetic ---- */

/* As in IEEE 754-2008, but for zeros of two signs, which sheets never compare. */
#define LEAST_OF(a, b) ((a) < (b) ? (a) : (b))
#define MOST_OF(a, b) ((a) > (b) ? (a) : (b))

#define BINARY(name, expression)                                                               \
    void CM_f_##name##_3_1L(CM_field_id_t dest, CM_field_id_t source1, CM_field_id_t source2,  \
                            unsigned int s, unsigned int e)                                    \
    {                                                                                          \
        (void)e;                                                                               \
        if (s == 52) {                                                                         \
            double *d = doubles(dest), *p = doubles(source1), *q = doubles(source2);           \
            EACH(double a = p[i]; double b = q[i]; d[i] = expression);                         \
        } else {                                                                               \
            float *d = floats(dest), *p = floats(source1), *q = floats(source2);               \
            EACH(float a = p[i]; float b = q[i]; d[i] = expression);                           \
        }                                                                                      \
    }                                                                                          \
    void CM_f_##name##_2_1L(CM_field_id_t dest, CM_field_id_t source, unsigned int s,          \
                            unsigned int e);                                                   \
    void CM_f_##name##_2_1L(CM_field_id_t dest, CM_field_id_t source, unsigned int s,          \
                            unsigned int e)                                                    \
    {                                                                                          \
        CM_f_##name##_3_1L(dest, dest, source, s, e);                                          \
    }
BINARY(add, a + b)
BINARY(subtract, a - b)
BINARY(multiply, a *b)
BINARY(divide, a / b)
BINARY(min, LEAST_OF(a, b))
BINARY(max, MOST_OF(a, b))

#define WITH_CONSTANT(name, expression)                                                        \
    void CM_f_##name##_constant_3_1L(CM_field_id_t dest, CM_field_id_t source, double value,   \
                                     unsigned int s, unsigned int e)                           \
    {                                                                                          \
        (void)e;                                                                               \
        if (s == 52) {                                                                         \
            double *d = doubles(dest), *p = doubles(source), b = value;                        \
            EACH(double a = p[i]; d[i] = expression);                                          \
        } else {                                                                               \
            float *d = floats(dest), *p = floats(source), b = (float)value;                    \
            EACH(float a = p[i]; d[i] = expression);                                           \
        }                                                                                      \
    }                                                                                          \
    void CM_f_##name##_constant_2_1L(CM_field_id_t dest, double value, unsigned int s,         \
                                     unsigned int e);                                          \
    void CM_f_##name##_constant_2_1L(CM_field_id_t dest, double value, unsigned int s,         \
                                     unsigned int e)                                           \
    {                                                                                          \
        CM_f_##name##_constant_3_1L(dest, dest, value, s, e);                                  \
    }
WITH_CONSTANT(add, a + b)
WITH_CONSTANT(subtract, a - b)
WITH_CONSTANT(subfrom, b - a)
WITH_CONSTANT(multiply, a *b)
WITH_CONSTANT(divide, a / b)
WITH_CONSTANT(min, LEAST_OF(a, b))
WITH_CONSTANT(max, MOST_OF(a, b))
WITH_CONSTANT(divinto, b / a)

void CM_f_sqrt_1_1L(CM_field_id_t dest, unsigned int s, unsigned int e)
{
    (void)s, (void)e;
    EACH(floats(dest)[i] = sqrtf(floats(dest)[i]));
}

void CM_f_exp_1_1L(CM_field_id_t dest, unsigned int s, unsigned int e)
{
    (void)s, (void)e;
    EACH(floats(dest)[i] = (float)exp((double)floats(dest)[i]));
}

void CM_u_add_2_1L(CM_field_id_t dest, CM_field_id_t source, unsigned int len)
{
    uint32_t mask = len == 32 ? UINT32_MAX : (1u << len) - 1;
    EACH(words(dest)[i] = (words(dest)[i] + words(source)[i]) & mask);
}

void CM_u_shift_constant_3_2L(CM_field_id_t dest, CM_field_id_t source, long value,
                              unsigned int dlen, unsigned int slen)
{
    (void)dlen, (void)slen; /* 33..64 bits, 32 or fewer */
    EACH(longs(dest)[i] = (uint64_t)words(source)[i] << value);
}

void CM_u_move_2L(CM_field_id_t dest, CM_field_id_t source, unsigned int dlen,
                  unsigned int slen)
{
    CM_u_shift_constant_3_2L(dest, source, 0, dlen, slen);
}

void CM_logior_2_1L(CM_field_id_t dest, CM_field_id_t source, unsigned int len)
{
    (void)len; /* 33..64 bits */
    EACH(longs(dest)[i] |= longs(source)[i]);
}

/* ---- moving and converting ---- */

void CM_f_move_1L(CM_field_id_t dest, CM_field_id_t source, unsigned int s, unsigned int e)
{
    (void)e;
    if (s == 52)
        EACH(doubles(dest)[i] = doubles(source)[i]);
    else
        EACH(floats(dest)[i] = floats(source)[i]);
}

void CM_f_move_constant_1L(CM_field_id_t dest, double value, unsigned int s, unsigned int e)
{
    (void)s, (void)e;
    float *d = floats(dest), number = (float)value;
    EACH(d[i] = number);
}

void CM_f_move_2L(CM_field_id_t dest, CM_field_id_t source, unsigned int ds, unsigned int de,
                  unsigned int ss, unsigned int se)
{
    (void)de, (void)se;
    if (ds == 52 && ss == 23)
        EACH(doubles(dest)[i] = (double)floats(source)[i]);
    else if (ds == 23 && ss == 52)
        EACH(floats(dest)[i] = (float)doubles(source)[i]);
    else
        abort();
}

void CM_u_move_constant_1L(CM_field_id_t dest, unsigned long value, unsigned int len)
{
    if (len > 32)
        EACH(longs(dest)[i] = value);
    else
        EACH(words(dest)[i] = (uint32_t)value);
}

void CM_f_u_float_2_2L(CM_field_id_t dest, CM_field_id_t source, unsigned int slen,
                       unsigned int s, unsigned int e)
{
    (void)slen, (void)e;
    if (s == 52)
        EACH(doubles(dest)[i] = words(source)[i]);
    else
        EACH(floats(dest)[i] = (float)words(source)[i]);
}

void CM_u_f_truncate_2_2L(CM_field_id_t dest, CM_field_id_t source, unsigned int dlen,
                          unsigned int s, unsigned int e)
{
    (void)dlen, (void)e;
    if (s == 52)
        EACH(words(dest)[i] = (uint32_t)doubles(source)[i]);
    else
        EACH(words(dest)[i] = (uint32_t)floats(source)[i]);
}

void CM_u_f_round_2_2L(CM_field_id_t dest, CM_field_id_t source, unsigned int dlen,
                       unsigned int s, unsigned int e)
{
    (void)dlen, (void)s, (void)e;
    EACH(words(dest)[i] = (uint32_t)rintf(floats(source)[i]));
}

void CM_my_news_coordinate_1L(CM_field_id_t dest, unsigned int axis, unsigned int len)
{
    (void)len;
    int width = the()->width;
    EACH(words(dest)[i] = (uint32_t)(axis == 0 ? i / width : i % width));
}

/* dest = the neighbour's source. Neighbours are read whether they are active or not. */
void CM_get_from_news_1L(CM_field_id_t dest, CM_field_id_t source, unsigned int axis,
                         unsigned int direction, unsigned int len)
{
    (void)len;
    static uint32_t *shifted;
    static int room;
    int width = the()->width, height = the()->height, count = the()->count;
    if (room < count) {
        free(shifted);
        shifted = malloc((size_t)count * sizeof *shifted);
        room = count;
    }
    const uint32_t *from = words(source);
    int step = direction == CM_upward ? 1 : -1;
    for (int y = 0; y < height; y++) {
        uint32_t *row = shifted + y * width;
        if (axis == 0) {
            memcpy(row, from + (y + step + height) % height * width,
                   (size_t)width * sizeof *row);
        } else if (step > 0) {
            memcpy(row, from + y * width + 1, (size_t)(width - 1) * sizeof *row);
            row[width - 1] = from[y * width];
        } else {
            memcpy(row + 1, from + y * width, (size_t)(width - 1) * sizeof *row);
            row[0] = from[y * width + width - 1];
        }
    }
    EACH(words(dest)[i] = shifted[i]);
}

/* ---- messages between sets: an address is a processor's row-major number ---- */

CM_sendaddr_t CM_fe_make_news_coordinate(CM_geometry_id_t geometry, unsigned int axis,
                                         unsigned int coordinate)
{
    return axis == 0 ? coordinate * (unsigned)geometries[geometry].width : coordinate;
}

CM_sendaddr_t CM_fe_deposit_news_coordinate(CM_geometry_id_t geometry, CM_sendaddr_t address,
                                            unsigned int axis, unsigned int coordinate)
{
    unsigned width = (unsigned)geometries[geometry].width;
    return axis == 0 ? coordinate * width + address % width
                     : address / width * width + coordinate;
}

void CM_get_1L(CM_field_id_t dest, CM_field_id_t address, CM_field_id_t source,
               unsigned int len)
{
    (void)len;
    EACH(words(dest)[i] = words(source)[words(address)[i]]);
}

/* Adds whole numbers, so their order does not matter. */
void CM_send_with_f_add_1L(CM_field_id_t dest, CM_field_id_t address, CM_field_id_t source,
                           unsigned int s, unsigned int e, CM_field_id_t notify)
{
    (void)s, (void)e, (void)notify;
    EACH(floats(dest)[words(address)[i]] += floats(source)[i]);
}

/* Only for fields of doubles, along axis 0 of a set whose height is a power of two. */
void CM_get_from_power_two_1L(CM_field_id_t dest, CM_field_id_t source, unsigned int axis,
                              unsigned int log2_distance, unsigned int direction,
                              unsigned int len)
{
    int width = the()->width, height = the()->height, distance = 1 << log2_distance;
    double *shifted = malloc((size_t)the()->count * sizeof *shifted);
    if (axis != 0 || len != 64 || direction != CM_upward || !the()->all || !shifted)
        abort();
    for (int i = 0; i < the()->count; i++)
        shifted[i] = doubles(source)[(i / width + distance) % height * width + i % width];
    memcpy(doubles(dest), shifted, (size_t)the()->count * sizeof *shifted);
    free(shifted);
}

void CM_f_gt_constant_1L(CM_field_id_t source, double value, unsigned int s, unsigned int e)
{
    (void)s, (void)e;
    EACH(the()->test[i] = floats(source)[i] > (float)value);
}

/* Sums whole numbers, so their order does not matter. */
double CM_global_f_add_1L(CM_field_id_t source, unsigned int s, unsigned int e)
{
    (void)e;
    if (s != 52)
        abort();
    double sum = 0;
    EACH(sum += doubles(source)[i]);
    return sum;
}

void CM_initialize_random_generator(unsigned int seed)
{
    random_state = seed;
}

void CM_u_random_1L(CM_field_id_t dest, unsigned int len, unsigned long limit)
{
    (void)limit;
    EACH(uint64_t z = random_state += UINT64_C(0x9e3779b97f4a7c15);
         z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u; z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
         words(dest)[i] = (uint32_t)((z ^ (z >> 31)) >> (64 - len)));
}

/* ---- the front end's arrays: rows from the top ---- */

static int bytes_of(unsigned int format)
{
    return format == CM_8_bit ? 1 : format == CM_16_bit ? 2 : format >= CM_float_double ? 8 : 4;
}

/* Where a block's rows are in the array, and their words in the field. Axes in their order. */
struct block {
    size_t rows, columns, array_width, array_at, field_at;
};

static struct block block_of(CM_vector_t offset, CM_vector_t start, CM_vector_t end,
                             CM_vector_t axes, CM_vector_t dimensions)
{
    int rows = end.ints[0] - start.ints[0], columns = end.ints[1] - start.ints[1];
    if (start.ints[0] < 0 || start.ints[1] < 0 || rows < 0 || columns < 0 ||
        end.ints[0] > the()->height || end.ints[1] > the()->width || axes.ints[0] != 0 ||
        axes.ints[1] != 1 || offset.ints[0] < 0 || offset.ints[1] < 0 ||
        offset.ints[0] + rows > dimensions.ints[0] ||
        offset.ints[1] + columns > dimensions.ints[1])
        abort();
    return (struct block){(size_t)rows, (size_t)columns, (size_t)dimensions.ints[1],
                          (size_t)(offset.ints[0] * dimensions.ints[1] + offset.ints[1]),
                          (size_t)(start.ints[0] * the()->width + start.ints[1])};
}

void CM_u_write_to_news_array_1L(const void *array, CM_vector_t offset, CM_vector_t start,
                                 CM_vector_t end, CM_vector_t axes, CM_field_id_t dest,
                                 unsigned int len, unsigned int rank, CM_vector_t dimensions,
                                 unsigned int format)
{
    (void)len, (void)rank;
    const struct block b = block_of(offset, start, end, axes, dimensions);
    const size_t bytes = (size_t)bytes_of(format);
    for (size_t row = 0; row < b.rows; row++) {
        const char *from = (const char *)array + (b.array_at + row * b.array_width) * bytes;
        const size_t to = b.field_at + row * (size_t)the()->width;
        if (bytes >= 4)
            memcpy((char *)fields[dest].words + to * bytes, from, b.columns * bytes);
        for (size_t i = 0; i < b.columns && bytes < 4; i++) {
            uint32_t x = 0;
            memcpy(&x, from + i * bytes, bytes);
            words(dest)[to + i] = x;
        }
    }
}

void CM_u_read_from_news_array_1L(void *array, CM_vector_t offset, CM_vector_t start,
                                  CM_vector_t end, CM_vector_t axes, CM_field_id_t source,
                                  unsigned int len, unsigned int rank, CM_vector_t dimensions,
                                  unsigned int format)
{
    (void)len, (void)rank;
    const struct block b = block_of(offset, start, end, axes, dimensions);
    const size_t bytes = (size_t)bytes_of(format);
    for (size_t row = 0; row < b.rows; row++) {
        char *to = (char *)array + (b.array_at + row * b.array_width) * bytes;
        const size_t from = b.field_at + row * (size_t)the()->width;
        if (bytes >= 4)
            memcpy(to, (const char *)fields[source].words + from * bytes, b.columns * bytes);
        for (size_t i = 0; i < b.columns && bytes < 4; i++)
            memcpy(to + i * bytes, &words(source)[from + i], bytes);
    }
}

void CM_f_write_to_news_array_1L(const void *array, CM_vector_t offset, CM_vector_t start,
                                 CM_vector_t end, CM_vector_t axes, CM_field_id_t dest,
                                 unsigned int s, unsigned int e, unsigned int rank,
                                 CM_vector_t dimensions, unsigned int format)
{
    (void)s, (void)e;
    CM_u_write_to_news_array_1L(array, offset, start, end, axes, dest, 32, rank, dimensions,
                                format);
}

void CM_f_read_from_news_array_1L(void *array, CM_vector_t offset, CM_vector_t start,
                                  CM_vector_t end, CM_vector_t axes, CM_field_id_t source,
                                  unsigned int s, unsigned int e, unsigned int rank,
                                  CM_vector_t dimensions, unsigned int format)
{
    (void)s, (void)e;
    CM_u_read_from_news_array_1L(array, offset, start, end, axes, source, 32, rank, dimensions,
                                 format);
}
