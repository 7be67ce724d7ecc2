/* h5.c - see h5.h. The places and numbers are those of the HDF5 File Format Specification,
 * version 1; of newer files version 3. */
#include "h5.h"
#include "h5_file.h"

#include <string.h>

enum {
    SUPERBLOCK = 0,
    ROOT = 96,
    TREE = 136,
    HEAP = 680,
    NAMES = 712,
    NAMES_BYTES = 72,
    NODE = 784,
    ARRAY = 1112
};
enum { CLASS_INTEGER, CLASS_FLOAT, CLASS_ENUM = 8 };
static const char signature[] = "\x89HDF\r\n\x1a\n";

/* ---- making ---- */

static uint8_t *put(uint8_t *at, uint64_t number, int bytes)
{
    for (int i = 0; i < bytes; i++)
        at[i] = (uint8_t)(number >> 8 * i);
    return at + bytes;
}

static void superblock_make(uint8_t *out, uint64_t end)
{
    memcpy(out, signature, 8);
    out[13] = out[14] = 8; /* bytes of an address and of a length */
    put(out + 16, 4, 2);   /* symbols: 2 * 4 in a node */
    put(out + 18, 16, 2);  /* children: 2 * 16 in a tree's node */
    put(out + 32, UINT64_MAX, 8);
    put(out + 40, end, 8);
    put(out + 48, UINT64_MAX, 8);
    put(out + 64, ROOT, 8);
    put(out + 72, 1, 4); /* what follows is known */
    put(out + 80, TREE, 8);
    put(out + 88, HEAP, 8);
}

static void group_make(uint8_t *out, const char *name)
{
    uint8_t *root = out + ROOT, *tree = out + TREE, *heap = out + HEAP, *node = out + NODE;
    put(root, 1, 1);
    put(root + 2, 1, 2); /* a message */
    put(root + 4, 1, 4);
    put(root + 8, 24, 4);
    put(root + 16, H5_MESSAGE_GROUP, 2);
    put(root + 18, 16, 2);
    put(root + 24, TREE, 8);
    put(root + 32, HEAP, 8);
    memcpy(tree, "TREE", 4);
    put(tree + 6, 1, 2); /* a child */
    put(tree + 8, UINT64_MAX, 8);
    put(tree + 16, UINT64_MAX, 8);
    put(tree + 32, NODE, 8);
    put(tree + 40, 8, 8); /* the last name in it */
    memcpy(heap, "HEAP", 4);
    put(heap + 8, NAMES_BYTES, 8);
    put(heap + 16, 1, 8); /* nothing is free */
    put(heap + 24, NAMES, 8);
    memcpy(out + NAMES + 8, name, strlen(name));
    memcpy(node, "SNOD\x01", 5);
    put(node + 6, 1, 2);
    put(node + 8, 8, 8);
    put(node + 16, ARRAY, 8);
}

static uint8_t *message_put(uint8_t *at, int type, int bytes)
{
    put(at, (uint64_t)type, 2);
    put(at + 2, (uint64_t)bytes, 2);
    return at + 8;
}

static void array_make(const struct npy *array, uint8_t *out, uint64_t bytes)
{
    const int space = 8 + 8 * array->rank;
    uint8_t *at = message_put(out + 16, H5_MESSAGE_SPACE, space);
    at[0] = 1;
    at[1] = (uint8_t)array->rank;
    for (int i = 0; i < array->rank; i++)
        put(at + 8 + 8 * i, array->shape[i], 8);
    at = message_put(at + space, H5_MESSAGE_TYPE, 24);
    const bool is_float = array->kind == 'f', wide = array->bytes == 8;
    at[0] = (uint8_t)(0x10 | (is_float ? CLASS_FLOAT : CLASS_INTEGER));
    at[1] = is_float             ? 0x20
            : array->kind == 'i' ? 8
                                 : 0; /* the leading 1 is not stored; signed */
    at[2] = is_float ? (uint8_t)(8 * array->bytes - 1) : 0; /* where the sign is */
    put(at + 4, array->bytes, 4);
    put(at + 10, 8 * array->bytes, 2);
    if (is_float) {
        at[12] = wide ? 52 : 23;
        at[13] = wide ? 11 : 8;
        at[15] = wide ? 52 : 23;
        put(at + 16, wide ? 1023 : 127, 4);
    }
    at = message_put(at + 24, H5_MESSAGE_LAYOUT, 24);
    at[0] = 3;
    at[1] = 1; /* in one piece */
    put(at + 2, H5_HEAD, 8);
    put(at + 10, bytes, 8);
    at += 24;
    put(out, 1, 1);
    put(out + 2, 3, 2);
    put(out + 4, 1, 4);
    put(out + 8, (uint64_t)(at - out - 16), 4);
}

void h5_make(const struct npy *array, const char *name, uint8_t out[H5_HEAD])
{
    uint64_t bytes = array->bytes;
    for (int i = 0; i < array->rank; i++)
        bytes *= array->shape[i];
    memset(out, 0, H5_HEAD);
    superblock_make(out, H5_HEAD + bytes);
    group_make(out, name);
    array_make(array, out + ARRAY, bytes);
}

/* ---- reading the array's header ---- */

struct found {
    struct npy *array;
    unsigned seen; /* bits: shape, type, place */
    uint64_t bytes;
};

static const char *space_take(struct npy *a, const uint8_t *data, size_t bytes)
{
    if (bytes < 4 || (data[0] != 1 && data[0] != 2) || data[1] > NPY_AXES_MAX ||
        bytes < (data[0] == 1 ? 8 : 4) + 8ul * data[1])
        return h5_damaged;
    const size_t begin = data[0] == 1 ? 8 : 4;
    a->rank = data[1];
    for (int i = 0; i < a->rank; i++)
        a->shape[i] = h5_number(data + begin + 8ul * (size_t)i, 8);
    return NULL;
}

static const char *type_take(struct npy *a, const uint8_t *data, size_t bytes)
{
    static const char other[] = "its elements are no plain integers or IEEE floats";
    if (bytes < 12)
        return h5_damaged;
    const int class = data[0] & 15;
    a->bytes = (unsigned int)h5_number(data + 4, 4);
    a->swapped = (data[1] & 1) && a->bytes > 1;
    if (class == CLASS_ENUM && a->bytes == 1) { /* as h5py has bools */
        a->kind = 'u';
        return NULL;
    }
    const uint64_t precision = h5_number(data + 10, 2);
    if ((class != CLASS_INTEGER && class != CLASS_FLOAT) || h5_number(data + 8, 2) != 0 ||
        a->bytes > 8 || precision != 8 * a->bytes)
        return other;
    a->kind = class == CLASS_FLOAT ? 'f' : data[1] & 8 ? 'i' : 'u';
    const uint8_t single[] = {23, 8, 0, 23, 127, 0}, twice[] = {52, 11, 0, 52, 255, 3};
    if (class == CLASS_FLOAT &&
        (bytes < 20 || (a->bytes != 4 && a->bytes != 8) || (data[1] & 0x40) ||
         memcmp(data + 12, a->bytes == 4 ? single : twice, 6) != 0))
        return other;
    return NULL;
}

static const char *layout_take(struct found *f, const uint8_t *data, size_t bytes)
{
    if (bytes < 2)
        return h5_damaged;
    if ((data[0] != 3 && data[0] != 4) || data[1] != 1)
        return "its array is not in one piece: it is compressed or chunked" H5_REPACK;
    if (bytes < 18)
        return h5_damaged;
    const uint64_t at = h5_number(data + 2, 8);
    f->bytes = h5_number(data + 10, 8);
    f->array->head = (size_t)at;
    return at == UINT64_MAX ? "its array was never written" : NULL;
}

static const char *array_take(void *context, unsigned type, const uint8_t *data, size_t bytes)
{
    struct found *f = context;
    if (type == H5_MESSAGE_SPACE) {
        f->seen |= 1;
        return space_take(f->array, data, bytes);
    }
    if (type == H5_MESSAGE_TYPE) {
        f->seen |= 2;
        return type_take(f->array, data, bytes);
    }
    if (type == H5_MESSAGE_LAYOUT) {
        f->seen |= 4;
        return layout_take(f, data, bytes);
    }
    return type == H5_MESSAGE_FILES ? "its array lies in another file" : NULL;
}

/* Where the root group's header is; UINT64_MAX: *wrong says why that is not known. */
static uint64_t root_of(FILE *in, const char **wrong)
{
    uint8_t block[100];
    const uint8_t *rest = NULL; /* where the file begins, three places, the root group */
    *wrong = NULL;
    if (!h5_bytes_at(in, 0, block, 48) || memcmp(block, signature, 8) != 0)
        *wrong = "it is no HDF5 file";
    else if (block[8] > 3)
        *wrong = "it is of a newer HDF5" H5_REPACK;
    else if (block[8] >= 2 && block[9] == 8 && block[10] == 8)
        rest = block + 12;
    else if (block[8] < 2 && block[13] == 8 && block[14] == 8 &&
             h5_bytes_at(in, 0, block, sizeof block))
        rest = block + (block[8] ? 28 : 24);
    else
        *wrong = h5_damaged;
    if (rest && h5_number(rest, 8) != 0)
        *wrong = h5_damaged;
    return *wrong ? UINT64_MAX : h5_number(rest + (block[8] >= 2 ? 24 : 40), 8);
}

const char *h5_read(FILE *in, const char *name, struct npy *array)
{
    struct h5_search s = {.in = in, .name = name, .left = 1 << 16};
    struct found f = {.array = array};
    const char *wrong;
    *array = (struct npy){0};
    const uint64_t root = root_of(in, &wrong);
    if (!wrong)
        wrong = h5_group_search(&s, root);
    if (!wrong)
        wrong = h5_header_read(in, s.header, array_take, &f);
    if (!wrong && f.seen != 7)
        wrong = "what has that name is no array";
    uint64_t bytes = array->bytes;
    for (int i = 0; !wrong && i < array->rank; i++)
        if (__builtin_mul_overflow(bytes, array->shape[i], &bytes))
            wrong = h5_damaged;
    return wrong ? wrong : bytes != f.bytes ? h5_damaged : NULL;
}
