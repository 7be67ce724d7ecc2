/* h5_links.c - see h5_file.h: the links of groups of HDF5 1.8 and later. Few of them are
 * messages of the group's header. Many are objects in a fractal heap, and a B-tree of version 2
 * has the place of each, by its name's hash. Here all are looked at, in the tree's order. */
#include "h5.h"
#include "h5_file.h"

#include <string.h>

const char *h5_link_take(struct h5_search *s, const uint8_t *data, size_t bytes)
{
    enum { ORDER = 4, KIND = 8, LETTERS = 16 };
    if (--s->left < 0 || bytes < 3 || data[0] != 1)
        return h5_damaged;
    const unsigned flags = data[1];
    const size_t name_bytes_at = 2u + (flags & KIND ? 1 : 0) + (flags & ORDER ? 8 : 0) +
                                 (flags & LETTERS ? 1 : 0),
                 name_at = name_bytes_at + (1u << (flags & 3));
    const bool hard = !(flags & KIND) || data[2] == 0;
    if (bytes < name_at)
        return h5_damaged;
    const uint64_t name_bytes = h5_number(data + name_bytes_at, 1 << (flags & 3));
    if (name_bytes == 0 ||
        name_bytes > bytes - name_at) /* or longer than what was read of it */
        return bytes < H5_MESSAGE_BYTES ? h5_damaged : NULL;
    if (*s->name && (name_bytes != strlen(s->name) ||
                     memcmp(data + name_at, s->name, (size_t)name_bytes) != 0))
        return NULL;
    if (!hard)
        return *s->name ? "what has that name is a link to somewhere else" : NULL;
    if (bytes < name_at + name_bytes + 8)
        return h5_damaged;
    s->header = h5_number(data + name_at + name_bytes, 8);
    s->found++;
    return NULL;
}

/* ---- the heap: an address space of blocks, row by row, whose sizes double from row to row
 * ---- */

struct heap {
    struct h5_search *search;
    unsigned width, offset_bytes;
    uint64_t first,
        direct_most; /* bytes of a block of the first row; of the largest that has objects */
    uint64_t root;
    unsigned rows; /* of the root; 0: it is a block of objects itself */
};

static bool is_power(uint64_t n)
{
    return n && (n & (n - 1)) == 0;
}

static const char *heap_open(struct h5_search *s, uint64_t at, struct heap *heap)
{
    uint8_t head[142];
    if (!h5_bytes_at(s->in, at, head, sizeof head) || memcmp(head, "FRHP", 5) != 0)
        return h5_damaged;
    if (h5_number(head + 7, 2) != 0)
        return "its links are compressed" H5_REPACK;
    *heap = (struct heap){.search = s,
                          .width = (unsigned)h5_number(head + 110, 2),
                          .first = h5_number(head + 112, 8),
                          .direct_most = h5_number(head + 120, 8),
                          .offset_bytes = ((unsigned)h5_number(head + 128, 2) + 7) / 8,
                          .root = h5_number(head + 132, 8),
                          .rows = (unsigned)h5_number(head + 140, 2)};
    return is_power(heap->width) && is_power(heap->first) && is_power(heap->direct_most) &&
                   heap->first <= heap->direct_most && heap->direct_most <= 1u << 31 &&
                   heap->offset_bytes <= 8 && heap->rows <= 64
               ? NULL
               : h5_damaged;
}

/* Where in the file the object at an offset of the heap is; UINT64_MAX: nowhere. */
static uint64_t heap_place(const struct heap *heap, uint64_t offset)
{
    uint64_t block = heap->root;
    unsigned rows = heap->rows;
    while (rows) {
        uint64_t size = heap->first, entry = 0;
        unsigned row = 0;
        for (; row < rows && offset / size >= heap->width; row++) {
            offset -= size * heap->width;
            entry += heap->width;
            if (row > 0)
                size *= 2;
            if (size > UINT64_MAX >> 17)
                return UINT64_MAX;
        }
        uint8_t head[5], child[8];
        entry += offset / size;
        if (row == rows || !h5_bytes_at(heap->search->in, block, head, sizeof head) ||
            memcmp(head, "FHIB", 5) != 0 ||
            !h5_bytes_at(heap->search->in, block + 13 + heap->offset_bytes + 8 * entry, child,
                         8))
            return UINT64_MAX;
        block = h5_number(child, 8);
        offset %= size;
        if (block == UINT64_MAX)
            return UINT64_MAX;
        if (size <= heap->direct_most)
            break;
        unsigned down = 0; /* rows of a block of blocks that is as large as this */
        for (uint64_t held = heap->first * heap->width; held <= size; held *= 2)
            down++;
        if (down >= rows)
            return UINT64_MAX;
        rows = down;
    }
    return block < INT64_MAX / 4 && offset < INT64_MAX / 4 ? block + offset : UINT64_MAX;
}

/* ---- the tree ---- */

enum { RECORD_OF_A_NAME = 5, TREE_HEAD = 6, TREE_CHECKSUM = 4, DEPTH_MOST = 8 };

struct tree {
    const struct heap *heap;
    uint64_t node_bytes;
    unsigned record_bytes;
    unsigned count_bytes;               /* of how many records a child has */
    unsigned all_bytes[DEPTH_MOST + 1]; /* of how many it and all below it have, by its depth */
};

static unsigned bytes_for(uint64_t number)
{
    unsigned bytes = 1;
    while (bytes < 8 && number >> 8 * bytes)
        bytes++;
    return bytes;
}

/* How wide the numbers in nodes are follows from how many records there may be below them. */
static bool tree_measure(struct tree *t, unsigned depth)
{
    if (t->record_bytes < 11 || t->node_bytes < TREE_HEAD + TREE_CHECKSUM + t->record_bytes)
        return false;
    uint64_t most = (t->node_bytes - TREE_HEAD - TREE_CHECKSUM) / t->record_bytes, all = most;
    t->count_bytes = bytes_for(most);
    t->all_bytes[0] = 0;
    for (unsigned level = 1; level <= depth; level++) {
        const uint64_t child = 8 + t->count_bytes + t->all_bytes[level - 1];
        if (t->node_bytes < TREE_HEAD + TREE_CHECKSUM + child)
            return false;
        most = (t->node_bytes - TREE_HEAD - TREE_CHECKSUM - child) / (t->record_bytes + child);
        if (__builtin_mul_overflow(most + 1, all, &all) ||
            __builtin_add_overflow(all, most, &all))
            return false;
        t->all_bytes[level] = bytes_for(all);
    }
    return true;
}

/* A record: the name's hash, then the place in the heap. */
static const char *record_read(const struct tree *t, uint64_t at)
{
    struct h5_search *s = t->heap->search;
    uint8_t record[4 + 1 + 8] = {0}, link[H5_MESSAGE_BYTES];
    const size_t bytes = t->record_bytes < sizeof record ? t->record_bytes : sizeof record;
    if (!h5_bytes_at(s->in, at, record, bytes) || (record[4] & 0xF0) != 0)
        return h5_damaged; /* links are never so small or so large that they lie elsewhere */
    const uint64_t place =
        heap_place(t->heap, h5_number(record + 5, (int)t->heap->offset_bytes));
    return place == UINT64_MAX
               ? h5_damaged
               : h5_link_take(s, link, h5_bytes_upto(s->in, place, link, sizeof link));
}

static const char *node_read(const struct tree *t, uint64_t at, uint64_t count, unsigned depth)
{
    struct h5_search *s = t->heap->search;
    uint8_t head[TREE_HEAD], child[8 + 8];
    if (--s->left < 0 || !h5_bytes_at(s->in, at, head, sizeof head) ||
        memcmp(head, depth ? "BTIN" : "BTLF", 5) != 0 || head[5] != RECORD_OF_A_NAME ||
        count > t->node_bytes / t->record_bytes)
        return h5_damaged;
    const char *wrong = NULL;
    for (uint64_t i = 0; i < count && !wrong; i++)
        wrong = record_read(t, at + TREE_HEAD + i * t->record_bytes);
    const unsigned step = 8 + t->count_bytes + (depth ? t->all_bytes[depth - 1] : 0);
    for (uint64_t i = 0; depth && i <= count && !wrong; i++) {
        const uint64_t pointer = at + TREE_HEAD + count * t->record_bytes + i * step;
        if (!h5_bytes_at(s->in, pointer, child, 8 + t->count_bytes))
            return h5_damaged;
        wrong = node_read(t, h5_number(child, 8), h5_number(child + 8, (int)t->count_bytes),
                          depth - 1);
    }
    return wrong;
}

const char *h5_links_read(struct h5_search *s, uint64_t heap_at, uint64_t tree_at)
{
    struct heap heap;
    uint8_t head[26];
    const char *wrong = heap_open(s, heap_at, &heap);
    if (wrong)
        return wrong;
    if (!h5_bytes_at(s->in, tree_at, head, sizeof head) || memcmp(head, "BTHD", 5) != 0 ||
        head[5] != RECORD_OF_A_NAME)
        return h5_damaged;
    struct tree t = {.heap = &heap,
                     .node_bytes = h5_number(head + 6, 4),
                     .record_bytes = (unsigned)h5_number(head + 10, 2)};
    const unsigned depth = (unsigned)h5_number(head + 12, 2);
    const uint64_t root = h5_number(head + 16, 8), count = h5_number(head + 24, 2);
    if (depth > DEPTH_MOST || !tree_measure(&t, depth))
        return h5_damaged;
    return root == UINT64_MAX ? NULL : node_read(&t, root, count, depth);
}
