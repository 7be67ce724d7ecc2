/* edits_list.c - edits.txt: see edits.h for what it holds. */
#include "edits_internal.h"

#include <array.h>
#include <output_file.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const level_names[FONT_EDITS_LEVELS] = {"outline", "master", "rectangles",
                                                           "filter", "gray"};

const char *font_edits_level_name(enum font_edits_level level)
{
    return level_names[level];
}

void font_edits_destroy(struct font_edits *edits)
{
    if (!edits)
        return;
    for (int i = 0; i < edits->rows_count; i++) {
        font_outline_finish(&edits->rows[i].outline);
        font_master_finish(&edits->rows[i].master);
        font_rectangles_finish(&edits->rows[i].rectangles);
        font_gray_finish(&edits->rows[i].gray);
        free(edits->rows[i].words);
        free(edits->rows[i].setting);
    }
    free(edits->rows);
    free(edits->folder);
    free(edits);
}

enum font_status edits_row_add(struct font_edits *edits, struct edits_row **out)
{
    if (edits->rows_count == EDITS_ROWS_MAX)
        return font_fail(FONT_TOO_LARGE, "%s/edits.txt: more than %d edits", edits->folder,
                         EDITS_ROWS_MAX);
    if (!array_reserve(&edits->rows, &edits->rows_capacity, edits->rows_count + 1,
                       sizeof *edits->rows))
        return font_fail(FONT_NO_MEMORY, "no memory for edits");
    *out = &edits->rows[edits->rows_count++];
    **out = (struct edits_row){0};
    return FONT_OK;
}

/* The next word of a line. False: there is none, or it is too long for the room. */
static bool word_take(const char **at, char *room, size_t bytes)
{
    size_t length = strcspn(*at, " \t\r\n");
    if (length == 0 || length >= bytes)
        return false;
    memcpy(room, *at, length);
    room[length] = '\0';
    *at += length;
    *at += strspn(*at, " \t\r");
    return true;
}

static bool is_sum(const char *word, size_t digits)
{
    return strlen(word) == digits && strspn(word, "0123456789abcdef") == digits;
}

/* What follows a row's sum, by its level: a master's or a gray's place, a filter's sizes. */
static bool numbers_take(struct edits_row *row, const char **at)
{
    struct font_edit *e = &row->edit;
    bool good = true;
    switch (e->level) {
    case FONT_EDITS_MASTER:
        good = edits_number(at, 1, FONT_MASTER_EM_MAX, &row->em_px);
        break;
    case FONT_EDITS_GRAY:
        good = edits_size(at, 0.1, FONT_SIDE_MAX, &e->from_px);
        e->to_px = e->from_px;
        break;
    case FONT_EDITS_FILTER:
        good = edits_size(at, 0, FONT_SIDE_MAX, &e->from_px) &&
               edits_size(at, 0, FONT_SIDE_MAX, &e->to_px) && e->from_px < e->to_px;
        break;
    case FONT_EDITS_OUTLINE:
    case FONT_EDITS_RECTANGLES:
    case FONT_EDITS_LEVELS:
        break;
    }
    if (e->level == FONT_EDITS_MASTER || e->level == FONT_EDITS_GRAY)
        good = good && edits_number(at, -EDITS_FAR, EDITS_FAR, &row->left_px) &&
               edits_number(at, -EDITS_FAR, EDITS_FAR, &row->top_px);
    return good;
}

/* The setting of axes that may end a row. */
static bool setting_take(struct edits_row *row, const char **at, enum font_status *status)
{
    char setting[EDITS_SETTING_BYTES];
    if (**at != '@')
        return true;
    if (!word_take(at, setting, sizeof setting))
        return false;
    row->setting = strdup(setting);
    if (!row->setting)
        *status = font_fail(FONT_NO_MEMORY, "no memory for edits");
    return true;
}

static enum font_status row_take(struct font_edits *edits, const char *at, int line)
{
    char level[16];
    struct edits_row *row = NULL;
    enum font_status status = edits_row_add(edits, &row);
    if (status != FONT_OK)
        return status;
    bool good = word_take(&at, row->name, sizeof row->name) &&
                word_take(&at, level, sizeof level) &&
                word_take(&at, row->file, sizeof row->file) &&
                word_take(&at, row->sum, sizeof row->sum) &&
                (is_sum(row->sum, EDITS_SUM) || strcmp(row->sum, "-") == 0);
    int kind = 0;
    while (good && kind < FONT_EDITS_LEVELS && strcmp(level_names[kind], level) != 0)
        kind++;
    good = good && kind < FONT_EDITS_LEVELS;
    row->edit.level = (enum font_edits_level)(good ? kind : 0);
    good = good && numbers_take(row, &at) && setting_take(row, &at, &status);
    if (status != FONT_OK)
        return status;
    if (!good || (*at && *at != '\n'))
        return font_fail(FONT_BAD_FILE,
                         "%s/edits.txt:%d: a row is a glyph, a level, its file and a sum or -, "
                         "of a master also em, left and top, of gray size, left and top, of a "
                         "filter the sizes from and to, and perhaps @ with axes",
                         edits->folder, line);
    if (!edits_file_is_plain(row->file))
        return font_fail(FONT_BAD_FILE,
                         "%s/edits.txt:%d: a file is a plain name in the folder (got '%.60s')",
                         edits->folder, line, row->file);
    return FONT_OK;
}

/* One of the lines before the rows. False: it is none of them. */
static bool head_take(struct font_edits *edits, const char *at)
{
    size_t length = strcspn(at, "\r\n");
    if (strncmp(at, "font ", 5) == 0 && length - 5 < sizeof edits->font) {
        snprintf(edits->font, sizeof edits->font, "%.*s", (int)(length - 5), at + 5);
        return edits->font[0] && !strchr(edits->font, '/') && edits->font[0] != '.';
    }
    if (strncmp(at, "sha256 ", 7) == 0) {
        at += 7;
        return word_take(&at, edits->sha256, sizeof edits->sha256) &&
               is_sum(edits->sha256, 64) && (!*at || *at == '\n');
    }
    if (strncmp(at, "face ", 5) == 0) {
        at += 5;
        return edits_number(&at, 0, 65535, &edits->face) && (!*at || *at == '\n');
    }
    return false;
}

static enum font_status lines_take(struct font_edits *edits, const char *text)
{
    enum { HEAD = 4 };
    static const char *const heads[HEAD] = {"lutetia edits 1", "font", "face", "sha256"};
    int line = 0, head = 0;
    enum font_status status = FONT_OK;
    for (const char *at = text; *at && status == FONT_OK;
         at += strcspn(at, "\n"), at += *at == '\n') {
        const char *from = at + strspn(at, " \t\r");
        line++;
        if (!*from || *from == '\n') {
            at = from;
            continue;
        }
        if (head == HEAD) {
            status = row_take(edits, from, line);
            continue;
        }
        size_t length = strlen(heads[head]);
        if (strncmp(from, heads[head], length) != 0 ||
            (head > 0 ? !head_take(edits, from) : !strchr("\r\n", from[length])))
            return font_fail(
                FONT_BAD_FILE,
                "%s/edits.txt:%d: the first lines are 'lutetia edits 1', font FILE, "
                "face N and sha256 with 64 digits; this is not %s",
                edits->folder, line, heads[head]);
        head++;
    }
    if (status == FONT_OK && head < HEAD)
        status = font_fail(FONT_BAD_FILE, "%s/edits.txt ends before its line '%s'",
                           edits->folder, heads[head]);
    return status;
}

enum font_status edits_list_read(const char *folder, struct font_edits **out)
{
    struct font_edits *edits = calloc(1, sizeof *edits);
    char *text = NULL;
    size_t count;
    *out = NULL;
    if (edits)
        edits->folder = strdup(folder);
    enum font_status status = edits && edits->folder
                                  ? edits_file_read(folder, "edits.txt", &text, &count)
                                  : font_fail(FONT_NO_MEMORY, "no memory for edits");
    if (status == FONT_OK && strlen(text) != count)
        status = font_fail(FONT_BAD_FILE, "%s/edits.txt is no text", folder);
    if (status == FONT_OK)
        status = lines_take(edits, text);
    free(text);
    if (status == FONT_OK)
        *out = edits;
    else
        font_edits_destroy(edits);
    return status;
}

enum font_status edits_list_write(const struct font_edits *edits)
{
    struct output_file out;
    char *path = edits_path(edits->folder, "edits.txt");
    if (!path)
        return font_fail(FONT_NO_MEMORY, "no memory for edits");
    enum font_status status = FONT_OK;
    if (!output_file_open(&out, path)) {
        status = font_fail(FONT_BAD_FILE, "%s: cannot write: %s", path, out.why);
        free(path);
        return status;
    }
    fprintf(out.stream, "lutetia edits 1\nfont %s\nface %d\nsha256 %s\n", edits->font,
            edits->face, edits->sha256);
    for (int i = 0; i < edits->rows_count; i++) {
        const struct edits_row *row = &edits->rows[i];
        fprintf(out.stream, "%s %s %s %s", row->name, level_names[row->edit.level], row->file,
                row->sum);
        if (row->edit.level == FONT_EDITS_MASTER)
            fprintf(out.stream, " %d %d %d", row->em_px, row->left_px, row->top_px);
        if (row->edit.level == FONT_EDITS_GRAY)
            fprintf(out.stream, " %.9g %d %d", row->edit.from_px, row->left_px, row->top_px);
        if (row->edit.level == FONT_EDITS_FILTER)
            fprintf(out.stream, " %.9g %.9g", row->edit.from_px, row->edit.to_px);
        if (row->setting)
            fprintf(out.stream, " %s", row->setting);
        fputc('\n', out.stream);
    }
    if (!output_file_commit(&out))
        status = font_fail(FONT_BAD_FILE, "%s: cannot write: %s", path, out.why);
    free(path);
    return status;
}
