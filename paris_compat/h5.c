/* h5.c - see h5.h. The places and numbers are those of the HDF5 File Format Specification, version 1. */
#include "h5.h"

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
enum {
    MESSAGE_SPACE = 1,
    MESSAGE_TYPE = 3,
    MESSAGE_FILES = 7,
    MESSAGE_LAYOUT = 8,
    MESSAGE_MORE = 16,
    MESSAGE_GROUP = 17
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
    put(root + 16, MESSAGE_GROUP, 2);
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
    uint8_t *at = message_put(out + 16, MESSAGE_SPACE, space);
    at[0] = 1;
    at[1] = (uint8_t)array->rank;
    for (int i = 0; i < array->rank; i++)
        put(at + 8 + 8 * i, array->shape[i], 8);
    at = message_put(at + space, MESSAGE_TYPE, 24);
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
    at = message_put(at + 24, MESSAGE_LAYOUT, 24);
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

/* ---- reading ---- */

#define REPACK "; `h5repack -l CONTI -f NONE OLD NEW` makes a file that is plain"
static const char damaged[] = "it is a damaged HDF5 file";

static uint64_t number_of(const uint8_t *at, int bytes)
{
    uint64_t n = 0;
    for (int i = 0; i < bytes; i++)
        n |= (uint64_t)at[i] << 8 * i;
    return n;
}

static bool bytes_at(FILE *in, uint64_t at, void *bytes, size_t count)
{
    return at < INT64_MAX / 2 && fseek(in, (long)at, SEEK_SET) == 0 &&
           fread(bytes, 1, count, in) == count;
}

/* Passes each message of an object's header. take() returns NULL, or what is wrong. */
enum { MESSAGES_MOST = 256, MESSAGE_BYTES = 1024 };
typedef const char *(*message_take)(void *context, unsigned type, const uint8_t *data,
                                    size_t bytes);

/* The messages within `left` bytes from `at` on; *next: a continuation. */
static const char *part_read(FILE *in, uint64_t at, uint64_t left, unsigned *messages,
                             uint64_t next[2], message_take take, void *context)
{
    while (left >= 8 && *messages > 0) {
        uint8_t head[8], data[MESSAGE_BYTES];
        if (!bytes_at(in, at, head, sizeof head))
            return damaged;
        const unsigned type = (unsigned)number_of(head, 2);
        const uint64_t bytes = number_of(head + 2, 2);
        const size_t kept = bytes < sizeof data ? (size_t)bytes : sizeof data;
        if (bytes > left - 8 || !bytes_at(in, at + 8, data, kept))
            return damaged;
        if (type == MESSAGE_MORE && kept >= 16) {
            next[0] = number_of(data, 8);
            next[1] = number_of(data + 8, 8);
        }
        const char *wrong = take(context, type, data, kept);
        if (wrong)
            return wrong;
        at += 8 + bytes;
        left -= 8 + bytes;
        --*messages;
    }
    return NULL;
}

static const char *header_read(FILE *in, uint64_t at, message_take take, void *context)
{
    uint8_t head[16];
    if (!bytes_at(in, at, head, sizeof head))
        return damaged;
    if (head[0] != 1)
        return "its object headers are of a newer HDF5" REPACK;
    unsigned messages = (unsigned)number_of(head + 2, 2);
    uint64_t next[2] = {at + 16, number_of(head + 8, 4)};
    if (messages > MESSAGES_MOST)
        messages = MESSAGES_MOST;
    while (next[1] && messages) {
        const uint64_t part[2] = {next[0], next[1]};
        const unsigned before = messages;
        next[1] = 0;
        const char *wrong = part_read(in, part[0], part[1], &messages, next, take, context);
        if (wrong)
            return wrong;
        if (messages == before)
            break;
    }
    return NULL;
}

struct group {
    uint64_t tree, heap;
};

static const char *group_take(void *context, unsigned type, const uint8_t *data, size_t bytes)
{
    struct group *g = context;
    if (type == MESSAGE_GROUP && bytes >= 16) {
        g->tree = number_of(data, 8);
        g->heap = number_of(data + 8, 8);
    }
    return NULL;
}

/* What is looked for in a group. */
struct search {
    FILE *in;
    const char *name;
    uint64_t names, names_bytes; /* the heap's segment */
    uint64_t header;             /* of what was found */
    int found, left;             /* nodes and names that may still be read */
};

static const char *symbols_read(struct search *s, uint64_t at)
{
    uint8_t head[8];
    if (!bytes_at(s->in, at, head, 8) || memcmp(head, "SNOD\x01", 5) != 0)
        return damaged;
    const unsigned count = (unsigned)number_of(head + 6, 2);
    for (unsigned i = 0; i < count; i++) {
        if (--s->left < 0)
            return damaged;
        uint8_t entry[16];
        char name[H5_NAME_MAX + 1] = "";
        if (!bytes_at(s->in, at + 8 + 40ull * i, entry, sizeof entry))
            return damaged;
        const uint64_t offset = number_of(entry, 8);
        if (offset >= s->names_bytes)
            return damaged;
        const uint64_t room = s->names_bytes - offset;
        if (!bytes_at(s->in, s->names + offset, name, room < sizeof name ? room : sizeof name))
            return damaged;
        if (memchr(name, '\0', sizeof name) && *s->name && strcmp(name, s->name) != 0)
            continue;
        if (*s->name && !memchr(name, '\0', sizeof name))
            continue; /* a longer one */
        s->header = number_of(entry + 8, 8);
        s->found++;
    }
    return NULL;
}

static const char *tree_read(struct search *s, uint64_t at, int level)
{
    uint8_t head[24];
    if (--s->left < 0 || !bytes_at(s->in, at, head, sizeof head) ||
        memcmp(head, "TREE", 5) != 0 || (level >= 0 && head[5] != level))
        return damaged;
    const unsigned count = (unsigned)number_of(head + 6, 2);
    for (unsigned i = 0; i < count; i++) {
        uint8_t child[8];
        if (!bytes_at(s->in, at + 32 + 16ull * i, child, 8))
            return damaged;
        const char *wrong = head[5] ? tree_read(s, number_of(child, 8), head[5] - 1)
                                    : symbols_read(s, number_of(child, 8));
        if (wrong)
            return wrong;
    }
    return NULL;
}

/* ---- the array's header ---- */

struct found {
    struct npy *array;
    unsigned seen; /* bits: shape, type, place */
    uint64_t bytes;
};

static const char *space_take(struct npy *a, const uint8_t *data, size_t bytes)
{
    if (bytes < 4 || (data[0] != 1 && data[0] != 2) || data[1] > NPY_AXES_MAX ||
        bytes < (data[0] == 1 ? 8 : 4) + 8ul * data[1])
        return damaged;
    const size_t begin = data[0] == 1 ? 8 : 4;
    a->rank = data[1];
    for (int i = 0; i < a->rank; i++)
        a->shape[i] = number_of(data + begin + 8ul * (size_t)i, 8);
    return NULL;
}

static const char *type_take(struct npy *a, const uint8_t *data, size_t bytes)
{
    static const char other[] = "its elements are no plain integers or IEEE floats";
    if (bytes < 12)
        return damaged;
    const int class = data[0] & 15;
    a->bytes = (unsigned int)number_of(data + 4, 4);
    a->swapped = (data[1] & 1) && a->bytes > 1;
    if (class == CLASS_ENUM && a->bytes == 1) { /* as h5py has bools */
        a->kind = 'u';
        return NULL;
    }
    const uint64_t precision = number_of(data + 10, 2);
    if ((class != CLASS_INTEGER && class != CLASS_FLOAT) || number_of(data + 8, 2) != 0 ||
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
        return damaged;
    if ((data[0] != 3 && data[0] != 4) || data[1] != 1)
        return "its array is not in one piece: it is compressed or chunked" REPACK;
    if (bytes < 18)
        return damaged;
    const uint64_t at = number_of(data + 2, 8);
    f->bytes = number_of(data + 10, 8);
    f->array->head = (size_t)at;
    return at == UINT64_MAX ? "its array was never written" : NULL;
}

static const char *array_take(void *context, unsigned type, const uint8_t *data, size_t bytes)
{
    struct found *f = context;
    if (type == MESSAGE_SPACE) {
        f->seen |= 1;
        return space_take(f->array, data, bytes);
    }
    if (type == MESSAGE_TYPE) {
        f->seen |= 2;
        return type_take(f->array, data, bytes);
    }
    if (type == MESSAGE_LAYOUT) {
        f->seen |= 4;
        return layout_take(f, data, bytes);
    }
    return type == MESSAGE_FILES ? "its array lies in another file" : NULL;
}

static const char *group_search(struct search *s, uint64_t root)
{
    struct group g = {0, 0};
    uint8_t heap[32];
    const char *wrong = header_read(s->in, root, group_take, &g);
    if (wrong)
        return wrong;
    if (!g.tree)
        return "its groups are of a newer HDF5" REPACK;
    if (!bytes_at(s->in, g.heap, heap, sizeof heap) || memcmp(heap, "HEAP", 5) != 0)
        return damaged;
    s->names_bytes = number_of(heap + 8, 8);
    s->names = number_of(heap + 24, 8);
    wrong = tree_read(s, g.tree, -1);
    if (!wrong && s->found == 0)
        wrong = *s->name ? "it has no array of that name" : "it has no array";
    if (!wrong && s->found > 1)
        wrong = "it has several arrays: name one, as in file.h5:NAME";
    return wrong;
}

const char *h5_read(FILE *in, const char *name, struct npy *array)
{
    uint8_t block[100];
    struct search s = {.in = in, .name = name, .left = 1 << 16};
    struct found f = {.array = array};
    *array = (struct npy){0};
    if (!bytes_at(in, 0, block, sizeof block) || memcmp(block, signature, 8) != 0)
        return "it is no HDF5 file";
    if (block[8] > 1 || block[13] != 8 || block[14] != 8)
        return "it is of a newer HDF5" REPACK;
    const uint8_t *rest = block + (block[8] ? 28 : 24);
    if (number_of(rest, 8) != 0)
        return damaged;
    const char *wrong = group_search(&s, number_of(rest + 40, 8));
    if (!wrong)
        wrong = header_read(in, s.header, array_take, &f);
    if (!wrong && f.seen != 7)
        wrong = "what has that name is no array";
    uint64_t bytes = array->bytes;
    for (int i = 0; !wrong && i < array->rank; i++)
        if (__builtin_mul_overflow(bytes, array->shape[i], &bytes))
            wrong = damaged;
    return wrong ? wrong : bytes != f.bytes ? damaged : NULL;
}
