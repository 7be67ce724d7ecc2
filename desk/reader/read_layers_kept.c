/* read_layers_kept.c - which layers are hidden, and which one is written, kept from one time to
 * the next.
 *
 * It is kept among the user's own data and not in the notes' file: that one is shared by
 * readers, of whom each looks at what she likes, and may be one that she cannot write to. There
 * is a file for each notes' file, called by a checksum of its path:
 *
 *     notes /home/anna/marsh.md.notes
 *     hidden Ben
 *     written Anna
 *
 * The layer without a name is a word with nothing behind it. */
#include "read_desk.h"

#include <input_file.h>
#include <output_file.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <user_folder.h>

/* The notes' path, whatever leads to its folder. */
static char *notes_path(const struct read_desk *d)
{
    char *folder = g_path_get_dirname(d->remarks_path),
         *name = g_path_get_basename(d->remarks_path), *real = realpath(folder, NULL);
    char *path = g_build_filename(real ? real : folder, name, NULL);
    free(real);
    g_free(folder);
    g_free(name);
    return path;
}

static char *kept_path(const char *notes, bool make)
{
    char *folder = g_build_filename(g_get_user_data_dir(), "lutetia", "layers", NULL),
         *name = g_compute_checksum_for_string(G_CHECKSUM_SHA256, notes, -1);
    if (make)
        user_folder_make(folder);
    char *path = g_build_filename(folder, name, NULL);
    g_free(folder);
    g_free(name);
    return path;
}

/* -1: there is no such layer by now. */
static int layer_of(const struct read_desk *d, const char *name)
{
    for (int i = 0; i < reader_remarks_layers(d->remarks); i++)
        if (strcmp(reader_remarks_layer(d->remarks, i), name) == 0)
            return i;
    return -1;
}

static void line_take(struct read_desk *d, const char *line)
{
    static const char hidden[] = "hidden ", written[] = "written ";
    const bool hides = g_str_has_prefix(line, hidden);
    if (!hides && !g_str_has_prefix(line, written))
        return;
    const int layer = layer_of(d, line + (hides ? sizeof hidden : sizeof written) - 1);
    if (layer >= 0 && hides)
        reader_remarks_layer_show(d->remarks, layer, false);
    else if (layer >= 0)
        reader_remarks_write_layer(d->remarks, layer);
}

void read_layers_kept(struct read_desk *d)
{
    enum { MOST = 1 << 16 };
    char *notes = notes_path(d), *path = kept_path(notes, false);
    size_t bytes;
    char *text = input_file_read(path, MOST, &bytes, NULL); /* NULL: nothing was kept */
    char **lines = g_strsplit(text ? text : "", "\n", -1);
    for (int i = 0; lines[i]; i++)
        line_take(d, lines[i]);
    g_strfreev(lines);
    free(text);
    g_free(path);
    g_free(notes);
}

/* False: it cannot be written, *why says why. */
static bool kept_write(const struct read_desk *d, const char *path, const char *notes,
                       char **why)
{
    struct output_file out;
    bool good = output_file_open(&out, path);
    if (good) {
        fprintf(out.stream, "notes %s\n", notes);
        for (int i = 0; i < reader_remarks_layers(d->remarks); i++)
            if (!reader_remarks_layer_shown(d->remarks, i))
                fprintf(out.stream, "hidden %s\n", reader_remarks_layer(d->remarks, i));
        fprintf(out.stream, "written %s\n",
                reader_remarks_layer(d->remarks, reader_remarks_written(d->remarks)));
        good = output_file_commit(&out);
    }
    *why = good ? NULL : g_strdup_printf(_("%s: cannot write: %s"), path, out.why);
    return good;
}

void read_layers_keep(struct read_desk *d)
{
    char *notes = notes_path(d), *path = kept_path(notes, true), *why;
    if (!kept_write(d, path, notes, &why))
        d->say(d, why);
    g_free(why);
    g_free(path);
    g_free(notes);
}
