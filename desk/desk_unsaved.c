/* desk_unsaved.c - journals of sheets that have no file yet: sheet-PROCESS-NUMBER.journal in
 * the user's own folder for data. */
#include "desk.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <signal.h>
#include <user_folder.h>

char *desk_unsaved_folder(void)
{
    char *folder = g_build_filename(g_get_user_data_dir(), "lutetia", "studio", NULL);
    user_folder_make(folder);
    if (!user_folder_wrong(folder))
        return folder;
    g_free(folder);
    return NULL;
}

/* A dead process's journal. */
static bool is_left(const char *name)
{
    int process;
    unsigned long number;
    if (!g_str_has_suffix(name, ".journal") ||
        sscanf(name, "sheet-%d-%lu.journal", &process, &number) != 2 || process < 1)
        return false;
    return kill(process, 0) != 0 && errno == ESRCH;
}

char *desk_unsaved_find(const char *folder)
{
    GDir *names = folder ? g_dir_open(folder, 0, NULL) : NULL;
    char *newest = NULL;
    gint64 written = 0;
    for (const char *name; names && (name = g_dir_read_name(names));) {
        GStatBuf status;
        char *path = g_build_filename(folder, name, NULL);
        if (is_left(name) && g_stat(path, &status) == 0 && (gint64)status.st_mtime >= written) {
            written = (gint64)status.st_mtime;
            g_free(newest);
            newest = g_steal_pointer(&path);
        }
        g_free(path);
    }
    if (names)
        g_dir_close(names);
    return newest;
}
