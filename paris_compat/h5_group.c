/* h5_group.c - see h5_file.h: groups of HDF5 1.0 to 1.6, whose names are in a heap, and what
 * decides between them and newer ones. */
#include "h5.h"
#include "h5_file.h"

#include <string.h>

struct group {
    struct h5_search *search;
    uint64_t tree, heap;             /* an old one's */
    uint64_t links_heap, links_tree; /* a new one's, where its header has no room for them */
    bool has_links;                  /* it is a new one */
};

static const char *group_take(void *context, unsigned type, const uint8_t *data, size_t bytes)
{
    struct group *g = context;
    if (type == H5_MESSAGE_GROUP && bytes >= 16) {
        g->tree = h5_number(data, 8);
        g->heap = h5_number(data + 8, 8);
    } else if (type == H5_MESSAGE_LINKS && bytes >= 2) {
        const size_t at = data[1] & 1 ? 10 : 2; /* the order of creation is kept */
        g->has_links = true;
        if (bytes < at + 16)
            return h5_damaged;
        g->links_heap = h5_number(data + at, 8);
        g->links_tree = h5_number(data + at + 8, 8);
    } else if (type == H5_MESSAGE_LINK) {
        return h5_link_take(g->search, data, bytes);
    }
    return NULL;
}

static const char *symbols_read(struct h5_search *s, uint64_t at)
{
    uint8_t head[8];
    if (!h5_bytes_at(s->in, at, head, 8) || memcmp(head, "SNOD\x01", 5) != 0)
        return h5_damaged;
    const unsigned count = (unsigned)h5_number(head + 6, 2);
    for (unsigned i = 0; i < count; i++) {
        if (--s->left < 0)
            return h5_damaged;
        uint8_t entry[16];
        char name[H5_NAME_MAX + 1] = "";
        if (!h5_bytes_at(s->in, at + 8 + 40ull * i, entry, sizeof entry))
            return h5_damaged;
        const uint64_t offset = h5_number(entry, 8);
        if (offset >= s->names_bytes)
            return h5_damaged;
        const uint64_t room = s->names_bytes - offset;
        if (!h5_bytes_at(s->in, s->names + offset, name,
                         room < sizeof name ? room : sizeof name))
            return h5_damaged;
        if (memchr(name, '\0', sizeof name) && *s->name && strcmp(name, s->name) != 0)
            continue;
        if (*s->name && !memchr(name, '\0', sizeof name))
            continue; /* a longer one */
        s->header = h5_number(entry + 8, 8);
        s->found++;
    }
    return NULL;
}

static const char *tree_read(struct h5_search *s, uint64_t at, int level)
{
    uint8_t head[24];
    if (--s->left < 0 || !h5_bytes_at(s->in, at, head, sizeof head) ||
        memcmp(head, "TREE", 5) != 0 || (level >= 0 && head[5] != level))
        return h5_damaged;
    const unsigned count = (unsigned)h5_number(head + 6, 2);
    for (unsigned i = 0; i < count; i++) {
        uint8_t child[8];
        if (!h5_bytes_at(s->in, at + 32 + 16ull * i, child, 8))
            return h5_damaged;
        const char *wrong = head[5] ? tree_read(s, h5_number(child, 8), head[5] - 1)
                                    : symbols_read(s, h5_number(child, 8));
        if (wrong)
            return wrong;
    }
    return NULL;
}

static const char *old_search(struct h5_search *s, const struct group *g)
{
    uint8_t heap[32];
    if (!h5_bytes_at(s->in, g->heap, heap, sizeof heap) || memcmp(heap, "HEAP", 5) != 0)
        return h5_damaged;
    s->names_bytes = h5_number(heap + 8, 8);
    s->names = h5_number(heap + 24, 8);
    return tree_read(s, g->tree, -1);
}

const char *h5_group_search(struct h5_search *s, uint64_t header)
{
    struct group g = {.search = s, .links_heap = UINT64_MAX};
    const char *wrong = h5_header_read(s->in, header, group_take, &g);
    if (!wrong && g.has_links && g.links_heap != UINT64_MAX)
        wrong = h5_links_read(s, g.links_heap, g.links_tree);
    else if (!wrong && g.tree)
        wrong = old_search(s, &g);
    else if (!wrong && !g.has_links)
        wrong = h5_damaged;
    if (!wrong && s->found == 0)
        wrong = *s->name ? "it has no array of that name" : "it has no array";
    if (!wrong && s->found > 1)
        wrong = "it has several arrays: name one, as in file.h5:NAME";
    return wrong;
}
