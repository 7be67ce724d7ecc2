/* studio_paper_sheets.c - the paper's thread: sheets that are made and opened, and their
 * journals. */
#include "studio_paper_internal.h"
#include "studio_session_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static bool pictures_change(struct studio_paper *p, int width, int height)
{
    struct studio_pictures *made = calloc(1, sizeof *made);
    uint8_t *view = malloc(3 * (size_t)width * (size_t)height);
    if (!made || !view || !studio_pictures_begin(made, width, height)) {
        free(made);
        free(view);
        return false;
    }
    free(p->view);
    p->view = view;
    pthread_mutex_lock(&p->lock);
    struct studio_pictures *before = p->pictures;
    p->pictures = made;
    const bool unseen = before != p->looked;
    pthread_mutex_unlock(&p->lock);
    if (before && unseen) { /* else the window ends them, when it looks again */
        studio_pictures_finish(before);
        free(before);
    }
    return true;
}

/* ---- journals ---- */

static void journal_path(const char *path, char *out, size_t room)
{
    snprintf(out, room, "%s.journal", path);
}

bool studio_paper_held(struct studio_paper *p, const char *path)
{
    char beside[STUDIO_TEXT_MAX + 64];
    journal_path(path, beside, sizeof beside);
    if (!p->kept || !studio_keeper_held(&p->keeper, beside))
        return false;
    studio_session_failed(
        PAPER_BAD_ARGUMENT,
        "%s: another studio has it open; close it there, or take another name", path);
    return true;
}

void studio_paper_journal(struct studio_paper *p, const char *path, const char *journal,
                          const struct paper_journal_found *found)
{
    char made[STUDIO_TEXT_MAX + 64];
    struct paper_sheet *sheet = studio_session_sheet(p->session);
    enum paper_status status = PAPER_OK;
    if (!p->kept || (!path && !journal && !p->def.folder))
        return;
    if (path)
        journal_path(path, made, sizeof made);
    else if (journal)
        snprintf(made, sizeof made, "%s", journal);
    else
        snprintf(made, sizeof made, "%s/sheet-%d-%lu.journal", p->def.folder, (int)getpid(),
                 p->now.sheets);
    if (found && found->continues)
        status = studio_keeper_continue(&p->keeper, sheet, made, found);
    else
        status = studio_keeper_watch(&p->keeper, sheet, made, path);
    if (status != PAPER_OK)
        studio_paper_complain(p);
}

/* What a journal that was left behind says too little about; and it is kept, if another one
 * would take its place. False: it would not be. */
static bool journal_judge(struct studio_paper *p, const char *journal, const char *why,
                          bool goes_on)
{
    char kept[STUDIO_TEXT_MAX + 80];
    if (goes_on) {
        studio_session_failed(PAPER_BAD_FILE,
                              "what was not saved is here again, but for its end: %s", why);
    } else if (studio_keeper_set_aside(journal, kept, sizeof kept)) {
        studio_session_failed(
            PAPER_BAD_FILE,
            "what was not saved cannot be found again (%s); its journal is kept: %s", why,
            kept);
    } else {
        studio_session_failed(PAPER_BAD_FILE,
                              "what was not saved cannot be found again (%s), and its journal "
                              "stays: %s; this sheet has none",
                              why, journal);
    }
    studio_paper_complain(p);
    return goes_on || access(journal, F_OK) != 0;
}

/* The sheet that was made takes the place of the one before. */
static void sheet_change(struct studio_paper *p, struct studio_session *made, const char *path)
{
    const struct paper_sheet_config *config =
        paper_sheet_get_config(studio_session_sheet(made));
    if (!pictures_change(p, config->width, config->height)) {
        studio_session_failed(PAPER_NO_MEMORY, "no memory for pictures of %dx%d fibers",
                              config->width, config->height);
        studio_paper_complain(p);
        studio_session_destroy(made);
        return;
    }
    if (p->kept)
        studio_keeper_leave(&p->keeper);
    studio_session_destroy(p->session);
    p->session = made;
    p->now.sheets++;
    p->now.config = *config;
    p->now.settings = *studio_session_settings(made);
    p->now.changed = p->now.found_again = false;
    snprintf(p->now.path, sizeof p->now.path, "%s", path ? path : "");
    p->dirty = p->view_other = p->flows = true;
    p->due = 0;
    studio_paper_flow_watch(p);
}

void studio_paper_sheet_make(struct studio_paper *p, const struct paper_sheet_config *config)
{
    struct studio_session *made;
    if (studio_session_create(config, p->def.budget_bytes, &made) != PAPER_OK) {
        studio_paper_complain(p);
        return;
    }
    sheet_change(p, made, NULL);
    if (p->session == made)
        studio_paper_journal(p, NULL, NULL, NULL);
}

void studio_paper_sheet_open(struct studio_paper *p, const char *path, const char *journal)
{
    char beside[STUDIO_TEXT_MAX + 64];
    struct paper_journal_found found = {0};
    struct studio_session *made;
    enum paper_status status;
    if (path && studio_paper_held(p, path)) {
        studio_paper_complain(p);
        return;
    }
    if (!journal) {
        journal_path(path, beside, sizeof beside);
        journal = access(beside, F_OK) == 0 ? beside : NULL;
    }
    if (journal)
        status = studio_session_find(journal, path, p->def.budget_bytes, &found, &made);
    else
        status = studio_session_open(path, p->def.budget_bytes, &made);
    if (status == PAPER_BAD_FILE && !path) { /* a journal alone */
        char why[STUDIO_TEXT_MAX];
        snprintf(why, sizeof why, "%s", studio_session_error());
        journal_judge(p, journal, why, false);
        return;
    }
    if (status != PAPER_OK) {
        studio_paper_complain(p);
        return;
    }
    sheet_change(p, made, path);
    if (p->session != made)
        return;
    p->now.changed = p->now.found_again = found.entries > 0;
    if (!found.why[0] || journal_judge(p, journal, found.why, found.continues))
        studio_paper_journal(p, path, journal, &found);
}
