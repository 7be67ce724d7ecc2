/* npy.c - see npy.h. */
#include "npy.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

size_t npy_make(const struct npy *npy, char *out)
{
    char text[1024];
    int n =
        snprintf(text, sizeof text, "{'descr': '%c%c%u', 'fortran_order': False, 'shape': (",
                 npy->bytes == 1 ? '|' : '<', npy->kind, npy->bytes);
    for (int i = 0; i < npy->rank; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, i ? " %" PRIu64 "," : "%" PRIu64 ",",
                      npy->shape[i]);
    if (npy->rank > 1)
        n--; /* the last comma; of one axis it stays */
    n += snprintf(text + n, sizeof text - (size_t)n, "), }");
    const size_t whole = (10 + (size_t)n + 1 + 63) / 64 * 64, length = whole - 10;
    memcpy(out, "\x93NUMPY\x01", 8); /* and a 0 */
    out[8] = (char)(length & 255);
    out[9] = (char)(length >> 8);
    memset(out + 10, ' ', length);
    memcpy(out + 10, text, (size_t)n);
    out[whole - 1] = '\n';
    return whole;
}

size_t npy_head_length(const uint8_t b[NPY_BEGIN])
{
    if (memcmp(b, "\x93NUMPY", 6) != 0 || b[6] < 1 || b[6] > 3)
        return 0;
    const size_t two = (size_t)b[8] | (size_t)b[9] << 8;
    if (b[6] == 1)
        return 10 + two;
    const size_t four = two | (size_t)b[10] << 16 | (size_t)b[11] << 24;
    return four <= NPY_HEAD_MAX - 12 ? 12 + four : 0;
}

/* ---- the dictionary ---- */

struct text {
    const char *at, *end;
};

static void spaces_skip(struct text *t)
{
    while (t->at < t->end && (*t->at == ' ' || *t->at == '\n' || *t->at == '\t'))
        t->at++;
}

static bool take(struct text *t, const char *word)
{
    spaces_skip(t);
    const size_t length = strlen(word);
    if ((size_t)(t->end - t->at) < length || memcmp(t->at, word, length) != 0)
        return false;
    t->at += length;
    return true;
}

/* A word in quotes, of `room` - 1 characters at most. */
static bool quoted(struct text *t, char *word, size_t room)
{
    spaces_skip(t);
    if (t->at == t->end || (*t->at != '\'' && *t->at != '"'))
        return false;
    const char quote = *t->at++;
    size_t n = 0;
    while (t->at < t->end && *t->at != quote && n + 1 < room)
        word[n++] = *t->at++;
    word[n] = '\0';
    return t->at < t->end && *t->at++ == quote;
}

static bool number(struct text *t, uint64_t *n)
{
    spaces_skip(t);
    const char *begin = t->at;
    *n = 0;
    while (t->at < t->end && *t->at >= '0' && *t->at <= '9') {
        if (*n > UINT32_MAX)
            return false;
        *n = 10 * *n + (uint64_t)(*t->at++ - '0');
    }
    return t->at > begin;
}

static const char *shape_read(struct text *t, struct npy *npy)
{
    npy->rank = 0;
    if (!take(t, "("))
        return "its shape is no tuple";
    while (!take(t, ")")) {
        if (npy->rank == NPY_AXES_MAX)
            return "its shape has too many axes";
        if (!number(t, &npy->shape[npy->rank++]))
            return "its shape has a length that is no number, or is too large";
        if (!take(t, ",") && !(take(t, ")") && t->at--))
            return "its shape has no end";
    }
    return NULL;
}

static const char *descr_read(struct text *t, struct npy *npy)
{
    char word[16];
    uint64_t bytes = 0;
    if (!quoted(t, word, sizeof word) || strlen(word) < 3)
        return "its elements are no plain numbers";
    struct text rest = {word + 2, word + strlen(word)};
    npy->kind = word[1];
    if (!strchr("<>|=", word[0]) || !strchr("buifc", word[1]) || !number(&rest, &bytes) ||
        rest.at != rest.end || bytes > 16)
        return "its elements are no plain numbers";
    npy->bytes = (unsigned int)bytes;
    npy->swapped = word[0] == '>' && bytes > 1;
    return NULL;
}

const char *npy_read(const uint8_t *head, size_t length, struct npy *npy)
{
    const size_t begin = head[6] == 1 ? 10 : 12;
    struct text t = {(const char *)head + begin, (const char *)head + length};
    unsigned int found = 0;
    *npy = (struct npy){.head = length};
    if (length < begin || !take(&t, "{"))
        return "its head is no dictionary";
    while (!take(&t, "}")) {
        char key[32];
        const char *wrong = NULL;
        if (!quoted(&t, key, sizeof key) || !take(&t, ":"))
            return "its head is no dictionary";
        if (strcmp(key, "descr") == 0) {
            wrong = descr_read(&t, npy);
            found |= 1;
        } else if (strcmp(key, "shape") == 0) {
            wrong = shape_read(&t, npy);
            found |= 2;
        } else if (strcmp(key, "fortran_order") == 0) {
            npy->fortran = take(&t, "True");
            wrong = npy->fortran || take(&t, "False") ? NULL : "its order is unknown";
            found |= 4;
        } else {
            wrong = "its head has an unknown key";
        }
        if (wrong)
            return wrong;
        take(&t, ",");
    }
    return found == 7 ? NULL : "its head lacks the type, the order or the shape";
}
