/* read_save.c - edits are saved, kept beside until they are, and joined with what other
 * programs have written meanwhile.
 *
 * Beside a file that is edited stands FILE.edits: a line that says of which bytes, and the
 * edited text. It is written at most a second after an edit, and goes when that is saved or
 * undone; a program that was killed finds its edits there. */
#include "read_edit.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <input_file.h>
#include <output_file.h>
#include <string.h>
#include <sys/stat.h>

enum { KEEP_MS = 700 };

#define EDITS_SIGN "lutetia edits 1 "

static GBytes *saved_of(const struct read_desk *d, int source)
{
    return source < (int)d->editing->saved->len ? g_ptr_array_index(d->editing->saved, source)
                                                : NULL;
}

static bool is_saved(const struct read_desk *d, int source)
{
    const struct reader_bytes *now = &d->files.texts[source];
    GBytes *saved = saved_of(d, source);
    return !saved ||
           (g_bytes_get_size(saved) == now->bytes &&
            (!now->bytes || memcmp(g_bytes_get_data(saved, NULL), now->text, now->bytes) == 0));
}

bool read_save_needed(const struct read_desk *d)
{
    for (int i = 0; d->document && i < d->files.count; i++)
        if (!is_saved(d, i))
            return true;
    return false;
}

/* The same file, included again, has been seen before. */
static bool seen_before(const struct read_desk *d, int source)
{
    for (int i = 0; i < source; i++)
        if (d->files.whole[i] && g_strcmp0(d->files.whole[i], d->files.whole[source]) == 0)
            return true;
    return false;
}

/* ---- writing ---- */

/* Why it could not be written; NULL: it was. */
static const char *file_write(const char *path, const char *head, const char *text,
                              size_t bytes, mode_t mode)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return out.why;
    fchmod(fileno(out.stream), mode);
    fputs(head, out.stream);
    if (bytes)
        fwrite(text, 1, bytes, out.stream);
    return output_file_commit(&out) ? NULL : out.why;
}

static mode_t mode_of(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 ? status.st_mode & 0777 : 0600;
}

/* ---- journals ---- */

static char *edits_path(const struct read_desk *d, int source)
{
    return g_strconcat(d->files.whole[source], ".edits", NULL);
}

static char *edits_head(GBytes *saved)
{
    char *digest = g_compute_checksum_for_bytes(G_CHECKSUM_SHA256, saved),
         *head = g_strdup_printf(EDITS_SIGN "%s\n", digest);
    g_free(digest);
    return head;
}

struct journal {
    char *path, *head, *text;
    size_t bytes;
    mode_t mode;
    const char *why;
};

static void journal_free(gpointer data)
{
    struct journal *j = data;
    g_free(j->path);
    g_free(j->head);
    g_free(j->text);
    g_free(j);
}

static void journal_write(GTask *task, gpointer source, gpointer data, GCancellable *cancel)
{
    struct journal *j = data;
    (void)source;
    (void)cancel;
    j->why = file_write(j->path, j->head, j->text, j->bytes, j->mode);
    g_task_return_boolean(task, TRUE);
}

static void journals_drop(struct read_desk *d)
{
    for (int i = 0; i < d->files.count; i++) {
        if (!d->files.whole[i] || !is_saved(d, i))
            continue;
        char *path = edits_path(d, i);
        g_unlink(path);
        g_free(path);
    }
}

static void journal_written(GObject *source, GAsyncResult *result, gpointer data)
{
    struct read_desk *d = data;
    const struct journal *j = g_task_get_task_data(G_TASK(result));
    (void)source;
    d->editing->writing--;
    if (j->why) {
        char *told = g_strdup_printf(_("Edits cannot be kept in %s: %s"), j->path, j->why);
        d->say(d, told);
        g_free(told);
    }
    if (!d->editing->writing && d->document)
        journals_drop(d);
}

static gboolean journals_keep(gpointer data)
{
    struct read_desk *d = data;
    struct read_editing *e = d->editing;
    if (e->writing)
        return G_SOURCE_CONTINUE;
    e->keeping = 0;
    journals_drop(d);
    for (int i = 0; i < d->files.count; i++) {
        if (!d->files.whole[i] || is_saved(d, i) || seen_before(d, i))
            continue;
        struct journal *j = g_new0(struct journal, 1);
        *j =
            (struct journal){.path = edits_path(d, i),
                             .head = edits_head(saved_of(d, i)),
                             .text = g_memdup2(d->files.texts[i].text, d->files.texts[i].bytes),
                             .bytes = d->files.texts[i].bytes,
                             .mode = mode_of(d->files.whole[i])};
        GTask *task = g_task_new(NULL, NULL, journal_written, d);
        g_task_set_task_data(task, j, journal_free);
        e->writing++;
        g_task_run_in_thread(task, journal_write);
        g_object_unref(task);
    }
    return G_SOURCE_REMOVE;
}

void read_save_soon(struct read_desk *d)
{
    if (!d->editing->keeping)
        d->editing->keeping = g_timeout_add(KEEP_MS, journals_keep, d);
}

/* What is being written is there. */
static void journals_wait(struct read_desk *d)
{
    if (d->editing->keeping)
        g_source_remove(d->editing->keeping);
    d->editing->keeping = 0;
    while (d->editing->writing)
        g_main_context_iteration(NULL, TRUE);
}

/* ---- two texts ---- */

/* Where two texts are other: bytes begin..a_end of the one are begin..b_end of the other. */
struct other {
    size_t begin, a_end, b_end;
};

static struct other other_find(const char *a, size_t a_bytes, const char *b, size_t b_bytes)
{
    struct other o = {0, a_bytes, b_bytes};
    while (o.begin < a_bytes && o.begin < b_bytes && a[o.begin] == b[o.begin])
        o.begin++;
    while (o.a_end > o.begin && o.b_end > o.begin && a[o.a_end - 1] == b[o.b_end - 1]) {
        o.a_end--;
        o.b_end--;
    }
    return o;
}

static enum reader_status source_become(struct read_desk *d, int source, size_t begin,
                                        size_t end, const char *text, size_t bytes)
{
    struct reader_edit_change change;
    const enum reader_status status =
        reader_edit_source(d->editing->edit, source, begin, end, text, bytes, &change);
    change.caret = MIN(reader_edit_moved(&change, d->editing->caret), d->document->plain_bytes);
    read_edit_changed(d, status, &change);
    return status;
}

/* What another program has changed comes into the edited text, where a line at least is between
 * both. False: it does not. */
static bool foreign_join(struct read_desk *d, int source, const char *theirs, size_t bytes)
{
    GBytes *saved = saved_of(d, source);
    const char *base = g_bytes_get_data(saved, NULL);
    const struct reader_bytes *mine = &d->files.texts[source];
    const size_t base_bytes = g_bytes_get_size(saved);
    const struct other they = other_find(base, base_bytes, theirs, bytes),
                       we = other_find(base, base_bytes, mine->text, mine->bytes);
    const bool ahead = they.a_end < we.begin &&
                       memchr(base + they.a_end, '\n', we.begin - they.a_end),
               behind = they.begin > we.a_end &&
                        memchr(base + we.a_end, '\n', they.begin - we.a_end);
    if (!ahead && !behind)
        return false;
    const size_t shift = behind ? we.b_end - we.a_end : 0; /* may wrap, and back again */
    return source_become(d, source, they.begin + shift, they.a_end + shift, theirs + they.begin,
                         they.b_end - they.begin) == READER_OK;
}

/* The edited text, in a file of its own beside. False: it could not be written. */
static bool beside_write(struct read_desk *d, const char *whole, const char *text, size_t bytes)
{
    char *path = NULL;
    for (int i = 1; i < 1000 && !path; i++) {
        path = i > 1 ? g_strdup_printf("%s.edited-%d.md", whole, i)
                     : g_strdup_printf("%s.edited.md", whole);
        if (g_file_test(path, G_FILE_TEST_EXISTS))
            g_clear_pointer(&path, g_free);
    }
    const char *why = path ? file_write(path, "", text, bytes, mode_of(whole))
                           : _("there are too many such files");
    char *told =
        why ? g_strdup_printf(_("%s was changed by another program where it was edited here, "
                                "and the edits cannot be written beside it: %s"),
                              whole, why)
            : g_strdup_printf(_("%s was changed by another program where it was edited here: "
                                "the edited text is %s"),
                              whole, path);
    d->say(d, told);
    g_free(told);
    g_free(path);
    return !why;
}

static void saved_set(struct read_desk *d, int source, const char *text, size_t bytes)
{
    for (int i = 0; i < d->files.count; i++)
        if (i == source ||
            (d->files.whole[i] && g_strcmp0(d->files.whole[i], d->files.whole[source]) == 0)) {
            g_bytes_unref(g_ptr_array_index(d->editing->saved, i));
            g_ptr_array_index(d->editing->saved, i) = g_bytes_new(text, bytes);
        }
}

enum foreign { FOREIGN_NONE, FOREIGN_JOINED, FOREIGN_OTHER, FOREIGN_STUCK };

/* Looks what the file is now. OTHER: the edits of it are beside, and it is to be read anew. */
static enum foreign foreign_take(struct read_desk *d, int source)
{
    size_t bytes;
    char *theirs = input_file_read(d->files.whole[source], READER_BYTES_MAX, &bytes, NULL);
    GBytes *saved = saved_of(d, source);
    enum foreign result = FOREIGN_NONE;
    if (!theirs || !saved ||
        (bytes == g_bytes_get_size(saved) &&
         (!bytes || memcmp(theirs, g_bytes_get_data(saved, NULL), bytes) == 0))) {
        free(theirs);
        return FOREIGN_NONE;
    }
    const struct reader_bytes *mine = &d->files.texts[source];
    if (is_saved(d, source))
        result = FOREIGN_OTHER;
    else if (foreign_join(d, source, theirs, bytes))
        result = FOREIGN_JOINED;
    else
        result = beside_write(d, d->files.whole[source], mine->text, mine->bytes)
                     ? FOREIGN_OTHER
                     : FOREIGN_STUCK;
    if (result == FOREIGN_JOINED)
        saved_set(d, source, theirs, bytes);
    free(theirs);
    return result;
}

void read_save_foreign(struct read_desk *d)
{
    bool other = false, needed = read_save_needed(d);
    if (!needed) {
        for (int i = 0; i < d->files.count; i++)
            other |= !d->files.whole[i] || foreign_take(d, i) == FOREIGN_OTHER;
        if (other)
            read_document_reload(d);
        return;
    }
    for (int i = 0; i < d->files.count; i++) {
        if (!d->files.whole[i] || seen_before(d, i))
            continue;
        const enum foreign foreign = foreign_take(d, i);
        if (foreign == FOREIGN_OTHER) { /* its bytes are those of the disk then */
            size_t bytes;
            char *theirs = input_file_read(d->files.whole[i], READER_BYTES_MAX, &bytes, NULL);
            if (theirs &&
                source_become(d, i, 0, d->files.texts[i].bytes, theirs, bytes) == READER_OK)
                saved_set(d, i, theirs, bytes);
            free(theirs);
        }
    }
    d->titled(d);
}

/* ---- saving ---- */

/* Whether the file has what another program has written, and that is neither joined nor is the
 * edited text beside: then nothing may replace it. */
static bool foreign_stands(const struct read_desk *d, int source)
{
    size_t bytes;
    GBytes *saved = saved_of(d, source);
    char *there = input_file_read(d->files.whole[source], READER_BYTES_MAX, &bytes, NULL);
    const bool stands = there && saved &&
                        (bytes != g_bytes_get_size(saved) ||
                         (bytes && memcmp(there, g_bytes_get_data(saved, NULL), bytes) != 0));
    free(there);
    return stands;
}

bool read_save(struct read_desk *d)
{
    bool good = true, any = false;
    if (!d->document || !read_save_needed(d))
        return true;
    read_save_foreign(d);
    for (int i = 0; i < d->files.count; i++) {
        if (is_saved(d, i) || seen_before(d, i))
            continue;
        const struct reader_bytes *now = &d->files.texts[i];
        const char *path = d->files.whole[i],
                   *why = foreign_stands(d, i)
                              ? _("another program has written it")
                              : file_write(path, "", now->text, now->bytes, mode_of(path));
        if (why) {
            char *told = g_strdup_printf(_("%s cannot be saved: %s"), path, why);
            d->say(d, told);
            g_free(told);
            good = false;
            continue;
        }
        saved_set(d, i, now->text, now->bytes);
        any = true;
    }
    if (any && good && d->remarks &&
        reader_remarks_saved(d->remarks, d->document->plain, d->document->plain_bytes) !=
            READER_OK)
        d->say(d, reader_error());
    journals_wait(d);
    journals_drop(d);
    reader_edit_part(d->editing->edit);
    d->titled(d);
    return good;
}

/* ---- what was not saved ---- */

static void edits_take(struct read_desk *d, int source, const char *path)
{
    size_t bytes;
    char *kept = input_file_read(path, READER_BYTES_MAX + 200, &bytes, NULL);
    char *head = edits_head(saved_of(d, source));
    const size_t length = strlen(head);
    const char *line = kept ? memchr(kept, '\n', bytes) : NULL;
    if (kept && line && g_str_has_prefix(kept, EDITS_SIGN)) {
        const char *text = line + 1;
        const size_t text_bytes = bytes - (size_t)(text - kept);
        if (bytes >= length && memcmp(kept, head, length) == 0) {
            const struct reader_bytes *now = &d->files.texts[source];
            const struct other o = other_find(now->text, now->bytes, text, text_bytes);
            if (source_become(d, source, o.begin, o.a_end, text + o.begin, o.b_end - o.begin) ==
                READER_OK)
                d->say(d, _("Edits that were not saved are here again: Ctrl+S saves them, "
                            "Ctrl+Z takes them back."));
        } else if (beside_write(d, d->files.whole[source], text, text_bytes)) {
            g_unlink(path);
        }
    }
    g_free(head);
    free(kept);
}

void read_save_recover(struct read_desk *d)
{
    if (read_document_is_manual(d) || !d->editing->edit)
        return;
    for (int i = 0; i < d->files.count; i++) {
        if (!d->files.whole[i] || seen_before(d, i))
            continue;
        char *path = edits_path(d, i);
        if (g_file_test(path, G_FILE_TEST_EXISTS))
            edits_take(d, i, path);
        g_free(path);
    }
}

/* Edits are given up. */
void read_save_discard(struct read_desk *d)
{
    journals_wait(d);
    for (int i = 0; i < d->files.count; i++)
        if (d->files.whole[i] && saved_of(d, i))
            saved_set(d, i, d->files.texts[i].text, d->files.texts[i].bytes);
    journals_drop(d);
}

/* ---- closing ---- */

bool read_save_answer(struct read_desk *d, int answer)
{
    struct read_editing *e = d->editing;
    if (!e->asking)
        return false;
    gtk_window_destroy(GTK_WINDOW(e->asking));
    e->asking = NULL;
    if (answer == GTK_RESPONSE_NO)
        read_save_discard(d);
    if (answer == GTK_RESPONSE_NO || (answer == GTK_RESPONSE_YES && read_save(d))) {
        e->asked = true;
        gtk_window_close(GTK_WINDOW(d->window));
    }
    return true;
}

static void answered(GtkDialog *dialog, int answer, struct read_desk *d)
{
    (void)dialog;
    read_save_answer(d, answer);
}

bool read_save_closes(struct read_desk *d)
{
    struct read_editing *e = d->editing;
    if (e->asked || !read_save_needed(d)) {
        journals_wait(d);
        return true;
    }
    if (e->asking)
        return false;
    e->asking =
        gtk_message_dialog_new(GTK_WINDOW(d->window), GTK_DIALOG_MODAL, GTK_MESSAGE_QUESTION,
                               GTK_BUTTONS_NONE, _("Edits have not been saved."));
    gtk_dialog_add_buttons(GTK_DIALOG(e->asking), _("Save"), GTK_RESPONSE_YES,
                           _("Give them up"), GTK_RESPONSE_NO, _("Stay here"),
                           GTK_RESPONSE_CANCEL, NULL);
    gtk_dialog_set_default_response(GTK_DIALOG(e->asking), GTK_RESPONSE_YES);
    g_signal_connect(e->asking, "response", G_CALLBACK(answered), d);
    gtk_window_present(GTK_WINDOW(e->asking));
    return false;
}
