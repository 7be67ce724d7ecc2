/* files.c - files that include others: see reader_files.h.
 *
 * What is included is read behind all that is there, file after file. Then the blocks of each
 * take the place of the one that includes it, all at once. */
#include "reader_files.h"

#include "builder.h"

#include <errno.h>
#include <input_file.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum reader_status no_memory(void)
{
    return reader_fail(READER_NO_MEMORY, "no memory for a document");
}

void reader_files_finish(struct reader_files *files)
{
    for (int i = 0; i < files->count; i++) {
        free(files->paths[i]);
        free(files->whole[i]);
        free(files->texts[i].text);
    }
    for (int i = 0; i < files->refused_count; i++)
        free(files->refused[i]);
    free(files->paths);
    free(files->whole);
    free(files->from);
    free(files->texts);
    *files = (struct reader_files){0};
}

/* The next source's; takes both paths. */
static enum reader_status path_add(struct reader_files *files, char *path, char *whole,
                                   int from)
{
    if (!path ||
        !array_reserve(&files->paths, &files->paths_capacity, files->count + 1,
                       sizeof *files->paths) ||
        !array_reserve(&files->whole, &files->whole_capacity, files->count + 1,
                       sizeof *files->whole) ||
        !array_reserve(&files->from, &files->from_capacity, files->count + 1,
                       sizeof *files->from) ||
        !array_reserve(&files->texts, &files->texts_capacity, files->count + 1,
                       sizeof *files->texts)) {
        free(path);
        free(whole);
        return no_memory();
    }
    files->paths[files->count] = path;
    files->whole[files->count] = whole;
    files->texts[files->count] = (struct reader_bytes){0};
    files->from[files->count++] = from;
    return READER_OK;
}

/* Keeps what the last source says. */
static enum reader_status text_keep(struct reader_files *files, const char *utf8, size_t bytes)
{
    if (!files->keep)
        return READER_OK;
    char *copy = malloc(bytes + 1);
    if (!copy)
        return no_memory();
    if (bytes)
        memcpy(copy, utf8, bytes);
    copy[bytes] = '\0';
    files->texts[files->count - 1] = (struct reader_bytes){copy, bytes};
    return READER_OK;
}

/* ---- which file ---- */

/* As many bytes as its folder has, with the last slash. */
static size_t folder_bytes(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash + 1 - path) : 0;
}

static bool ends_with(const char *text, const char *end)
{
    const size_t bytes = strlen(text), ending = strlen(end);
    return bytes > ending && strcmp(text + bytes - ending, end) == 0;
}

/* A file that is being included; what is not NULL is freed by who made it. */
struct included {
    char *path, *whole, *text;
    size_t bytes;
};

static void included_finish(struct included *in)
{
    free(in->path);
    free(in->whole);
    free(in->text);
    *in = (struct included){0};
}

/* Why no such file may be meant; NULL: it may. */
static const char *target_wrong(const struct reader_files *files, int source,
                                const char *target)
{
    if (!files->whole[source])
        return "what is piped in includes no files";
    if (!ends_with(target, ".md") && !ends_with(target, ".markdown") &&
        !ends_with(target, ".txt"))
        return "only .md, .markdown and .txt are included";
    if (target[0] == '/' || strchr(target, ':') || strstr(target, ".."))
        return "a file that is included lies in the document's folder or below it";
    return NULL;
}

/* Whether a file is in the folder of another path, or below that, whatever links led there. */
static bool is_below(const char *whole, const char *path)
{
    const size_t bytes = folder_bytes(path);
    char *folder = bytes ? strndup(path, bytes) : strdup("."),
         *real = folder ? realpath(folder, NULL) : NULL;
    const size_t length = !real ? 0 : strcmp(real, "/") == 0 ? 0 : strlen(real);
    const bool below = real && strncmp(whole, real, length) == 0 && whole[length] == '/';
    free(folder);
    free(real);
    return below;
}

/* Why the file that was found is not to be read; NULL: it is. */
static const char *place_wrong(const struct reader_files *files, int source, const char *whole)
{
    int depth = 0, named = source;
    for (int at = source; at >= 0; at = files->from[at], depth++) {
        if (strcmp(files->whole[at], whole) == 0)
            return "it includes itself";
        named = at;
    }
    if (!is_below(whole, files->paths[named]))
        return "a file that is included lies in the document's folder or below it";
    if (depth > READER_INCLUDES_DEPTH_MAX)
        return "files include each other up to 8 deep";
    return files->count >= READER_FILES_MAX ? "a document has up to 1000 files" : NULL;
}

/* What is held of a file; NULL: nothing. */
static const struct reader_bytes *held_find(const struct reader_files *files, const char *whole)
{
    for (int i = 0; files->held && i < files->held->count; i++)
        if (files->held->whole[i] && files->held->texts[i].text &&
            strcmp(files->held->whole[i], whole) == 0)
            return &files->held->texts[i];
    return NULL;
}

/* Its bytes; NULL: *why says why not. */
static const char *text_read(struct reader_files *files, struct included *in)
{
    const double left = READER_BYTES_MAX - files->bytes;
    const char *why = NULL;
    if (held_find(files, in->whole)) {
        const struct reader_bytes *held = held_find(files, in->whole);
        in->text = (double)held->bytes <= left ? malloc(held->bytes + 1) : NULL;
        if (!in->text)
            return (double)held->bytes <= left ? "there is no memory for it"
                                               : "what is included has up to 32 MB";
        memcpy(in->text, held->text, held->bytes + 1);
        in->bytes = held->bytes;
        files->bytes += (double)in->bytes;
        return NULL;
    }
    in->text = input_file_read(in->whole, left > 0 ? (size_t)left : 0, &in->bytes, &why);
    files->bytes += (double)in->bytes;
    return in->text ? NULL : errno == EFBIG ? "what is included has up to 32 MB" : why;
}

/* Why it is not included; NULL: it is here. */
static const char *included_open(struct reader_files *files, int source, const char *target,
                                 struct included *in)
{
    const char *why = target_wrong(files, source, target);
    const char *by = files->paths[source];
    if (why)
        return why;
    if (asprintf(&in->path, "%.*s%s", (int)folder_bytes(by), by, target) < 0) {
        in->path = NULL;
        return "there is no memory for it";
    }
    in->whole = realpath(in->path, NULL);
    if (!in->whole)
        return strerror(errno);
    why = place_wrong(files, source, in->whole);
    return why ? why : text_read(files, in);
}

int reader_files_source(const struct reader_files *files, int from, const char *path,
                        size_t bytes)
{
    char *named = NULL, *whole = NULL;
    int source = -1;
    if (!files || from < 0 || from >= files->count || bytes >= PATH_MAX)
        return -1;
    if (asprintf(&named, "%.*s%.*s", (int)folder_bytes(files->paths[from]), files->paths[from],
                 (int)bytes, path) < 0)
        return -1;
    whole = realpath(named, NULL);
    for (int i = 0; whole && source < 0 && i < files->count; i++)
        source = files->whole[i] && strcmp(files->whole[i], whole) == 0 ? i : -1;
    free(whole);
    free(named);
    return source;
}

/* ---- including ---- */

static enum reader_status refused_add(struct reader_files *files,
                                      const struct reader_block *block, const char *why)
{
    files->refused_all++;
    if (files->refused_count == READER_REFUSED_MAX)
        return READER_OK;
    char **line = &files->refused[files->refused_count];
    if (asprintf(line, "%s:%d: %.200s is not included: %s", files->paths[block->source],
                 block->first_line, block->include, why) < 0)
        return no_memory();
    files->refused_count++;
    return READER_OK;
}

/* What one block includes: blocks begin..begin + count - 1. */
struct taken {
    int block, begin, count;
};
struct takes {
    struct taken *items;
    int count, capacity;
};

static enum reader_status include_take(struct reader_files *files, struct reader_document *d,
                                       int at, struct takes *takes)
{
    const struct reader_block *block = &d->blocks[at];
    struct included in = {0};
    const int source = block->source, before = d->blocks_count;
    const char *why = included_open(files, source, block->include, &in);
    if (why || !array_reserve(&takes->items, &takes->capacity, takes->count + 1,
                              sizeof *takes->items)) {
        enum reader_status status = why ? refused_add(files, block, why) : no_memory();
        included_finish(&in);
        return status;
    }
    char *path = in.path, *whole = in.whole;
    in.path = in.whole = NULL;
    enum reader_status status = path_add(files, path, whole, source);
    if (status == READER_OK)
        status = text_keep(files, in.text, in.bytes);
    if (status == READER_OK)
        status = reader_document_add(d, in.text, in.bytes);
    if (status != READER_OK && status != READER_NO_MEMORY) {
        char *said = strdup(reader_error());
        if (said)
            reader_fail(status, "%s: %s", files->paths[files->count - 1], said);
        free(said);
    }
    if (status == READER_OK && d->blocks_count > before) /* an empty file stays a link */
        takes->items[takes->count++] = (struct taken){at, before, d->blocks_count - before};
    included_finish(&in);
    return status;
}

/* ---- in their places ---- */

struct order {
    const struct reader_document *document;
    int first;
    const struct taken **taken; /* of each block from the first on; NULL: none */
    struct reader_block *blocks;
    int *places, count; /* places: of each block, where it comes to stand */
};

/* At most READER_INCLUDES_DEPTH_MAX deep. */
static void blocks_order(struct order *o, int begin, int end)
{
    for (int i = begin; i < end; i++) {
        const struct taken *taken = o->taken[i - o->first];
        o->places[i - o->first] = o->count;
        if (taken)
            blocks_order(o, taken->begin, taken->begin + taken->count);
        else
            o->blocks[o->count++] = o->document->blocks[i];
    }
}

/* The named file's blocks are first..own - 1, and those behind them are included. */
static enum reader_status includes_place(struct reader_document *d, int first, int own,
                                         const struct takes *takes)
{
    const size_t room = (size_t)(d->blocks_count - first);
    struct order o = {.document = d,
                      .first = first,
                      .taken = calloc(room, sizeof(struct taken *)),
                      .blocks = malloc(room * sizeof *o.blocks),
                      .places = malloc(room * sizeof *o.places)};
    const bool good = o.taken && o.blocks && o.places;
    for (int i = 0; good && i < takes->count; i++)
        o.taken[takes->items[i].block - first] = &takes->items[i];
    if (good)
        blocks_order(&o, first, own);
    for (int i = 0; good && i < takes->count; i++)
        reader_block_finish(&d->blocks[takes->items[i].block]);
    for (int i = 0; good && i < d->labels_count; i++)
        if (d->labels[i].block >= first)
            d->labels[i].block = first + o.places[d->labels[i].block - first];
    if (good) {
        memcpy(d->blocks + first, o.blocks, (size_t)o.count * sizeof *o.blocks);
        d->blocks_count = first + o.count;
    }
    free(o.taken);
    free(o.blocks);
    free(o.places);
    return good ? READER_OK : no_memory();
}

enum reader_status reader_files_add(struct reader_files *files, struct reader_document *d,
                                    const char *path, const char *utf8, size_t bytes)
{
    const int first = d->blocks_count;
    struct takes takes = {0};
    char *copy = strdup(path);
    enum reader_status status =
        path_add(files, copy, strcmp(path, "-") == 0 ? NULL : realpath(path, NULL), -1);
    if (status == READER_OK)
        status = text_keep(files, utf8, bytes);
    if (status == READER_OK)
        status = reader_document_add(d, utf8, bytes);
    const int own = d->blocks_count;
    for (int i = first; i < d->blocks_count && status == READER_OK; i++)
        if (d->blocks[i].include)
            status = include_take(files, d, i, &takes);
    if (status == READER_OK && takes.count)
        status = includes_place(d, first, own, &takes);
    free(takes.items);
    return status;
}
