/* read_document.c - the document's files, what links lead to, and the way back. */
#include "read_desk.h"

#include <beside.h>
#include <input_file.h>
#include <reader_edit.h>
#include <string.h>
#include <user_folder.h>

/* ---- reading ---- */

/* A file's bytes; NULL: it was said why not. */
static char *file_read(struct read_desk *d, const char *path, size_t *bytes)
{
    const char *why = "";
    FILE *file = input_file_open(path, &why);
    char *text = NULL, *told = NULL;
    size_t room = READER_BYTES_MAX + (size_t)1;
    if (!file)
        told = g_strdup_printf("%s: %s", path, why);
    else {
        GByteArray *all = g_byte_array_new();
        guint8 piece[65536];
        for (size_t got; (got = fread(piece, 1, sizeof piece, file)) > 0 && all->len < room;)
            g_byte_array_append(all, piece, (guint)got);
        if (ferror(file))
            told = g_strdup_printf(_("%s cannot be read whole"), path);
        *bytes = all->len;
        text = (char *)g_byte_array_free(all, told != NULL);
        fclose(file);
    }
    if (told)
        d->say(d, told);
    g_free(told);
    return told ? NULL : text ? text : g_strdup("");
}

static bool picture_find(void *user, int source, const char *target, struct reader_picture *out)
{
    const struct read_desk *d = user;
    struct display_image image;
    uint8_t *alpha;
    if (source < 0 || source >= d->files.count ||
        !display_beside_read_alpha(d->files.paths[source], target, &image, &alpha))
        return false;
    *out = (struct reader_picture){image.width_px, image.height_px, image.pixels, alpha};
    return true;
}

static struct reader_document *files_read(struct read_desk *d, struct reader_files *files)
{
    struct reader_document *document = NULL;
    bool good = reader_document_create(&document) == READER_OK;
    files->keep = true;
    for (guint i = 0; i < d->options.paths->len && good; i++) {
        const char *path = g_ptr_array_index(d->options.paths, i);
        size_t bytes = 0;
        char *text = file_read(d, path, &bytes);
        good = text && reader_files_add(files, document, path, text, bytes) == READER_OK;
        if (text && !good) {
            char *told = g_strdup_printf("%s: %s", path, reader_error());
            d->say(d, told);
            g_free(told);
        }
        g_free(text);
    }
    if (good && (reader_files_refer(files, document) != READER_OK ||
                 reader_document_plain(document) != READER_OK)) {
        d->say(d, reader_error());
        good = false;
    }
    if (good)
        return document;
    reader_document_destroy(document);
    reader_files_finish(files);
    return NULL;
}

/* In place of the document that there is; takes both. False: it was said why not, and all is as
 * it was. */
static bool document_take(struct read_desk *d, struct reader_document *document,
                          const struct reader_files *files)
{
    struct reader_document *before = d->document;
    struct reader_files files_before = d->files;
    struct reader_view *view;
    d->setup.picture = picture_find;
    d->setup.picture_user = d;
    d->document = document;
    d->files = *files;
    read_look_set(d); /* there may be notes */
    if (reader_view_create(document, &d->setup, &view) != READER_OK) {
        d->say(d, reader_error());
        reader_files_finish(&d->files);
        d->document = before;
        d->files = files_before;
        reader_document_destroy(document);
        return false;
    }
    read_stages_forget(d);
    reader_view_destroy(d->view);
    reader_document_destroy(before);
    reader_files_finish(&files_before);
    d->view = view;
    g_array_set_size(d->hits, 0);
    d->hit = -1;
    d->selected = (struct read_range){0, 0};
    d->focused = G_MAXSIZE;
    read_tiles_forget(d->tiles);
    return true;
}

bool read_document_is_manual(const struct read_desk *d)
{
    return d->options.manual && d->options.paths == d->options.manual;
}

/* What readers leave is kept beside the document's first file. The manual belongs to all: its
 * notes are kept among the reader's own data. Owns: the caller frees it. */
static char *notes_file(const struct read_desk *d)
{
    if (!read_document_is_manual(d))
        return g_strconcat(g_ptr_array_index(d->options.paths, 0), ".notes", NULL);
    char *folder = g_build_filename(g_get_user_data_dir(), "lutetia", NULL);
    char *file = g_build_filename(folder, "manual.notes", NULL);
    user_folder_make(folder);
    g_free(folder);
    return file;
}

/* Says which references lead nowhere, and which files are not included. */
static void lost_tell(struct read_desk *d)
{
    const struct reader_document *document = d->document;
    for (int i = 0; i < d->files.refused_count; i++)
        d->say(d, d->files.refused[i]);
    if (!document->lost_all)
        return;
    const struct reader_lost *first = &document->lost[0];
    const char *path = d->files.paths[first->source];
    char *told =
        document->lost_all > 1
            ? g_strdup_printf(_("%s:%d: there is no label #%s, nor that of %ld others: they "
                                "stand as they are written"),
                              path, first->line, first->label, document->lost_all - 1)
            : g_strdup_printf(_("%s:%d: there is no label #%s: it stands as it is written"),
                              path, first->line, first->label);
    d->say(d, told);
    g_free(told);
}

bool read_document_open(struct read_desk *d)
{
    struct reader_files files = {0};
    struct reader_document *document = files_read(d, &files);
    if (!document || !document_take(d, document, &files))
        return false;
    char *notes = notes_file(d);
    read_remarks_open(d, notes);
    g_free(notes);
    d->edits_begin(d);
    lost_tell(d);
    d->document_shown(d);
    read_page_changed(d);
    d->edits_recover(d);
    return true;
}

void read_document_reload(struct read_desk *d)
{
    struct reader_anchor *anchor = NULL;
    struct reader_files files = {0};
    struct reader_document *document = files_read(d, &files);
    size_t top = 0, begin = 0, end = 0;
    double above, all;
    if (!document || !d->view) {
        reader_document_destroy(document);
        reader_files_finish(&files);
        return;
    }
    reader_view_extent(d->view, &above, &all);
    if (reader_view_top(d->view, &top) == READER_OK) {
        const size_t bytes = d->document->plain_bytes;
        const size_t last = MIN(top + 40, bytes);
        reader_anchor_make(d->document->plain, bytes, MIN(top, bytes), last, &anchor);
    }
    if (document_take(d, document, &files)) {
        const bool found =
            anchor && reader_anchor_find(anchor, document->plain, document->plain_bytes, &begin,
                                         &end) != READER_ANCHOR_ORPHAN;
        if (found)
            reader_view_go(d->view, begin, 0);
        else
            reader_view_go_part(d->view, all > 0 ? above / all : 0);
        read_remarks_find(d);
        d->edits_begin(d);
        lost_tell(d);
        d->document_shown(d);
        read_page_changed(d);
        read_stages_again(d);
    }
    reader_anchor_destroy(anchor);
}

/* Another document: the line that is being read stays where it is. */
static void view_replace(struct read_desk *d, const struct reader_edit_change *change)
{
    struct reader_box box = {0};
    struct reader_view *view;
    size_t top = 0;
    read_look_set(d); /* there may be notes */
    reader_view_top(d->view, &top);
    reader_view_caret(d->view, top, false, &box);
    if (reader_view_create(d->document, &d->setup, &view) != READER_OK) {
        d->say(d, reader_error());
        d->view = NULL; /* of a document that goes */
        return;
    }
    reader_view_as(view, d->view);
    reader_view_destroy(d->view);
    d->view = view;
    reader_view_go(view, reader_edit_moved(change, top), box.y);
    read_text_around(d);
    read_stages_follow_document(d, change->before);
    read_tiles_forget(d->tiles);
}

void read_document_edited(struct read_desk *d, const struct reader_edit_change *change)
{
    if (change->before) {
        view_replace(d, change);
        return;
    }
    for (int i = 0; i < change->moves_count; i++)
        if (reader_view_edited(d->view, change->block, change->moves[i].at,
                               change->moves[i].removed,
                               change->moves[i].inserted) != READER_OK)
            d->say(d, reader_error());
    read_stages_edited(d, change->block);
    read_text_around(d);
}

void read_document_finish(struct read_desk *d)
{
    reader_view_destroy(d->view);
    reader_document_destroy(d->document);
    reader_files_finish(&d->files);
    d->view = NULL;
    d->document = NULL;
    g_array_free(d->way, TRUE);
}

/* ---- the way back ---- */

static void place_clear(gpointer item)
{
    g_ptr_array_unref(((struct read_place *)item)->paths);
}

/* The place that is being read, at the way's present end. */
static void place_keep(struct read_desk *d)
{
    struct read_place place = {.paths = g_ptr_array_ref(d->options.paths)};
    reader_view_top(d->view, &place.byte);
    if (!d->way->len)
        g_array_set_clear_func(d->way, place_clear);
    if (d->way_at < d->way->len)
        g_array_remove_range(d->way, d->way_at, d->way->len - d->way_at);
    g_array_append_val(d->way, place);
    d->way_at = d->way->len;
}

void read_document_go(struct read_desk *d, size_t byte)
{
    place_keep(d);
    reader_view_go(d->view, byte, d->size_px);
    read_page_changed(d);
    d->acted(d);
}

/* Another document in place of this one; false: it cannot be opened, and this one stays. */
static bool other_open(struct read_desk *d, GPtrArray *paths)
{
    GPtrArray *before = d->options.paths;
    if (paths == before)
        return true;
    if (d->edits_needed(d)) {
        d->say(d, _("Save what was edited first: Ctrl+S."));
        return false;
    }
    d->options.paths = g_ptr_array_ref(paths);
    const bool good = read_document_open(d);
    g_ptr_array_unref(good ? before : d->options.paths);
    if (!good)
        d->options.paths = before;
    return good;
}

bool read_document_can(const struct read_desk *d, bool forward)
{
    return forward ? d->way_at + 1 < d->way->len : d->way_at > 0;
}

void read_document_back(struct read_desk *d, bool forward)
{
    if (!d->view || !read_document_can(d, forward))
        return;
    if (!forward && d->way_at == d->way->len) { /* so that one can come forward again */
        place_keep(d);
        d->way_at--;
    }
    d->way_at = forward ? d->way_at + 1 : d->way_at - 1;
    const struct read_place place = g_array_index(d->way, struct read_place, d->way_at);
    if (other_open(d, place.paths))
        reader_view_go(d->view, place.byte, 0);
    read_page_changed(d);
    d->acted(d);
}

/* ---- links ---- */

/* The heading or label of that name, of one of the document's files (-1: of any). */
static bool label_find(const struct read_desk *d, const char *wanted, int source, size_t *byte)
{
    const struct reader_block *block = reader_document_label(d->document, wanted, source);
    if (block)
        *byte = block->at;
    return block != NULL;
}

static bool is_markdown(const char *path)
{
    return g_str_has_suffix(path, ".md") || g_str_has_suffix(path, ".markdown") ||
           g_str_has_suffix(path, ".txt");
}

/* Which of the document's files that is; -1: none. */
static int source_of(const struct read_desk *d, const char *path)
{
    int source = -1;
    char *whole = g_canonicalize_filename(path, NULL);
    for (int i = 0; i < d->files.count && source < 0; i++) {
        char *own = g_canonicalize_filename(d->files.paths[i], NULL);
        source = strcmp(own, whole) == 0 ? i : -1;
        g_free(own);
    }
    g_free(whole);
    return source;
}

/* Where a file of the document begins; false: there is nothing in it. */
static bool source_begin(const struct read_desk *d, int source, size_t *byte)
{
    for (int i = 0; i < d->document->blocks_count; i++)
        if (d->document->blocks[i].source == source) {
            *byte = d->document->blocks[i].at;
            return true;
        }
    return false;
}

/* To a file, in this document or in place of it, and a heading of that (NULL: its begin). */
static void file_go(struct read_desk *d, const char *path, const char *heading)
{
    int source = source_of(d, path);
    size_t byte = 0;
    place_keep(d);
    if (source < 0) {
        GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
        g_ptr_array_add(paths, g_strdup(path));
        source = other_open(d, paths) ? 0 : -1;
        g_ptr_array_unref(paths);
    }
    if (source >= 0 &&
        ((heading && label_find(d, heading, source, &byte)) || source_begin(d, source, &byte)))
        reader_view_go(d->view, byte, d->size_px);
    read_page_changed(d);
    d->acted(d);
}

/* A file beside that with the link, and a heading in it. */
static bool file_link(struct read_desk *d, const char *target, int source)
{
    char **parts = g_strsplit(target, "#", 2);
    char *folder = g_path_get_dirname(d->files.paths[source]);
    char *path = g_path_is_absolute(parts[0]) ? g_strdup(parts[0])
                                              : g_build_filename(folder, parts[0], NULL);
    const bool good = is_markdown(path);
    if (good)
        file_go(d, path, parts[1]);
    g_free(path);
    g_free(folder);
    g_strfreev(parts);
    return good;
}

/* source: which of the document's files has the link. */
static bool link_follow(struct read_desk *d, const char *target, int source)
{
    char *told = NULL;
    size_t byte;
    if (target[0] == '#') {
        if (label_find(d, target + 1, source, &byte) || label_find(d, target + 1, -1, &byte))
            read_document_go(d, byte);
        else
            told =
                g_strdup_printf(_("There is no heading or label %s in this document."), target);
    } else if (g_str_has_prefix(target, "https://") || g_str_has_prefix(target, "http://") ||
               g_str_has_prefix(target, "mailto:")) {
        gtk_show_uri(GTK_WINDOW(d->window), target, GDK_CURRENT_TIME);
    } else if (strchr(target, ':') || !file_link(d, target, source)) {
        told = g_strdup_printf(
            _("%.200s is not followed: only Markdown, https: and mailto: are."), target);
    }
    if (told)
        d->say(d, told);
    g_free(told);
    return true;
}

bool read_document_follow(struct read_desk *d, size_t byte)
{
    const struct reader_span *span = reader_document_span(d->document, byte);
    if (span && (span->look & READER_NOTE)) {
        if (reader_view_note(d->view, span->note, byte) != READER_OK)
            d->say(d, reader_error());
        read_page_changed(d);
        return true;
    }
    return span && (span->look & READER_LINK) && span->target &&
           link_follow(d, span->target, reader_document_block(d->document, byte)->source);
}
