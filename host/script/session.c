/* session.c - see script_session.h. */
#include "script_session.h"

#include "script_paper.h"
#include "script_text.h"

#include <arguments.h>
#include <bands.h>
#include <brush.h>
#include <describe.h>
#include <display.h>
#include <history.h>
#include <number_text.h>
#include <output_file.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SEED_MOST = 2147483647, POINTS_MOST = 20000, PATH_ROOM = 4096, WHY_ROOM = 512 };

static _Thread_local char why[WHY_ROOM];

const char *script_session_error(void)
{
    return why;
}

__attribute__((format(printf, 1, 2))) static bool failed(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(why, sizeof why, format, list);
    va_end(list);
    return false;
}

struct session {
    struct paper_sheet *sheet;
    const struct paper_sheet_config *config;
    struct event_bytes text;
    char folder[PATH_ROOM], name[PATH_ROOM]; /* of the script, without its ending */
    int pictures;
    bool brushes[PAPER_BRUSHES_MAX]; /* that the script has in variables */
};

/* ---- the paper ---- */

static const char *const parts[] = {"infused", "surface", "fixing", "edge"};
static const char *const rules[] = {"kubelka-munk", "subtract", "luminous"};

/* All of it, so that a script paints the same when there are other paints of that name. */
static void pigment_say(struct event_bytes *text, const struct paper_pigment *pigment)
{
    script_text_say(text, "{name = ");
    script_text_quoted(text, pigment->name);
    script_text_fields(text, &paper_pigment_members, pigment);
    if (paper_pigment_banded(pigment) || pigment->shift > 0)
        script_text_fields(text, &paper_bands_members, pigment);
    script_text_say(text, "}");
}

static bool paper_say(struct session *s)
{
    const struct paper_sheet_config *c = s->config;
    struct event_bytes *text = &s->text;
    if (c->seed > SEED_MOST)
        return failed("a script's paper has a seed of up to %d (this one has %llu)", SEED_MOST,
                      (unsigned long long)c->seed);
    if (!paper_stock_find(c->stock.name))
        return failed("scripts know no paper stock '%s'", c->stock.name);
    script_text_say(text,
                    "local p = paper{width = %d, height = %d, seed = %llu, torus = %s,\n"
                    "                rule = \"%s\", model = ",
                    c->width, c->height, (unsigned long long)c->seed,
                    c->torus ? "true" : "false", rules[c->rule]);
    const char *between = "{";
    script_text_say(text, c->parts ? "" : "\"thesis\"");
    for (int i = 0; i < 4; i++)
        if (c->parts >> i & 1) {
            script_text_say(text, "%s\"%s\"", between, parts[i]);
            between = ", ";
        }
    script_text_say(text,
                    c->parts ? "},\n                stock = " : ",\n                stock = ");
    script_text_quoted(text, c->stock.name);
    script_text_say(text, ", color = {%.17g, %.17g, %.17g}", c->stock.color[0],
                    c->stock.color[1], c->stock.color[2]);
    if (!script_text_fields(text, &paper_stock_members, &c->stock))
        return failed("a script cannot say this paper's stock");
    if (c->deckled) {
        script_text_say(text, ",\n                deckle = {");
        script_text_fields(text, &paper_deckle_members, &c->deckle);
        script_text_say(text, "}");
    }
    script_text_say(text, ",\n                pigments = {");
    for (int i = 0; i < c->pigments_count; i++) {
        pigment_say(text, &c->pigments[i]);
        script_text_say(text, i + 1 < c->pigments_count ? ", " : "");
    }
    script_text_say(text, "}}\n");
    return true;
}

/* ---- operations ---- */

static void amounts_say(struct session *s, const double *amount)
{
    const char *between = "";
    script_text_say(&s->text, "{");
    for (int i = 0; i <= s->config->pigments_count; i++) {
        if (amount[i] == 0)
            continue;
        script_text_say(&s->text, "%s[", between);
        script_text_quoted(&s->text, i == 0 ? "water" : s->config->pigments[i - 1].name);
        script_text_say(&s->text, "] = ");
        script_text_number(&s->text, amount[i]);
        between = ", ";
    }
    script_text_say(&s->text, "}");
}

/* image("...", x, y): the screen as a picture beside the script. */
static bool screen_say(struct session *s, const struct paper_place *place)
{
    const struct paper_screen *screen = place->screen;
    struct display_image image = {screen->width_px, screen->height_px, 1, NULL};
    char path[2 * PATH_ROOM + 32], name[PATH_ROOM + 32];
    snprintf(name, sizeof name, "%s-%d.png", s->name, ++s->pictures);
    snprintf(path, sizeof path, "%s%s", s->folder, name);
    const size_t count = (size_t)screen->width_px * (size_t)screen->height_px;
    if (display_image_create(&image) != DISPLAY_OK)
        return failed("%s", display_error());
    for (size_t i = 0; i < count; i++)
        image.pixels[i] = (uint8_t)(255 - screen->gray[i]);
    const bool written = display_png_write(path, &image) == DISPLAY_OK;
    display_image_destroy(&image);
    if (!written)
        return failed("%s", display_error());
    script_text_say(&s->text, "image(");
    script_text_quoted(&s->text, name);
    script_text_say(&s->text, ", %d, %d)", place->x, place->y);
    return true;
}

/* Each says an operation, or answers that it cannot; *ok false: it failed. */

static bool air_say(struct session *s, const struct paper_air *air)
{
    const struct paper_air usual = paper_air_default();
    if (!s->config->parts || memcmp(&air->thesis, &usual.thesis, sizeof usual.thesis) != 0)
        return false;
    script_text_say(&s->text, "p:air{");
    script_text_fields(&s->text, &paper_air_members, air);
    script_text_say(&s->text, "}\n");
    return true;
}

static bool brush_say(struct session *s, const struct paper_brush *brush)
{
    struct paper_brush like = paper_brush_default();
    const size_t before = s->text.count;
    s->brushes[brush->number] = false;
    if (brush->seed > SEED_MOST)
        return false;
    const char *kind = NULL;
    for (int i = 0; !kind && paper_brush_kind(i); i++)
        if (paper_brush_of_kind(&like, paper_brush_kind(i)) && like.flat == brush->flat)
            kind = paper_brush_kind(i);
    if (!kind)
        return false;
    script_text_say(&s->text, "b%d = p:brush{number = %d, kind = \"%s\", seed = %llu",
                    brush->number + 1, brush->number + 1, kind,
                    (unsigned long long)brush->seed);
    if (!script_text_fields(&s->text, &paper_brush_members, brush)) {
        s->text.count = before; /* an angle that degrees cannot say */
        return false;
    }
    script_text_say(&s->text, "}\n");
    s->brushes[brush->number] = true;
    return true;
}

static bool dip_say(struct session *s, const struct paper_dip *dip)
{
    if (!s->brushes[dip->number])
        return false;
    script_text_say(&s->text, "b%d:dip(", dip->number + 1);
    amounts_say(s, dip->amount);
    script_text_say(&s->text, ", {part = %.17g, side = {%.17g, %.17g}})\n", dip->part,
                    dip->side[0], dip->side[1]);
    return true;
}

static bool stroke_say(struct session *s, const struct paper_stroke *stroke)
{
    if (!s->brushes[stroke->number] || stroke->samples_count > POINTS_MOST)
        return false;
    script_text_say(&s->text, "p:stroke{brush = b%d, pace = %.17g, points = {",
                    stroke->number + 1, stroke->pace);
    for (int i = 0; i < stroke->samples_count; i++) {
        const struct paper_stroke_sample *at = &stroke->samples[i];
        const double numbers[6] = {at->x,      at->y,      at->pressure,
                                   at->time_s, at->tilt_x, at->tilt_y};
        script_text_say(&s->text, i % 2 ? " {" : "\n  {");
        for (int j = 0; j < 6; j++) {
            script_text_say(&s->text, j > 0 ? ", " : "");
            script_text_number(&s->text, numbers[j]);
        }
        script_text_say(&s->text, "},");
    }
    script_text_say(&s->text, "}}\n");
    return true;
}

/* p:put(mask, {...}) and the like: the mask, then `rest`. */
static bool masked_say(struct session *s, const char *method, const struct paper_place *place,
                       bool *ok)
{
    if (!place->screen)
        return false;
    script_text_say(&s->text, "p:%s(", method);
    *ok = screen_say(s, place);
    return true;
}

static bool put_say(struct session *s, const struct event_put *put, bool *ok)
{
    if (!put->place.screen)
        script_text_say(&s->text, "p:wash(");
    else if (masked_say(s, "put", &put->place, ok))
        script_text_say(&s->text, ", ");
    amounts_say(s, put->amount);
    script_text_say(&s->text, ")\n");
    return true;
}

static bool operation_said(struct session *s, const char *what, const void *arguments, bool *ok)
{
    const struct event_blot *blot = arguments;
    const struct event_resist *resist = arguments;
    const struct paper_lift *lift = arguments;
    const struct paper_varnish *varnish = arguments;
    if (strcmp(what, "air") == 0)
        return air_say(s, arguments);
    if (strcmp(what, "brush") == 0)
        return brush_say(s, arguments);
    if (strcmp(what, "dip") == 0)
        return dip_say(s, arguments);
    if (strcmp(what, "stroke") == 0)
        return stroke_say(s, arguments);
    if (strcmp(what, "put") == 0)
        return put_say(s, arguments, ok);
    if (strcmp(what, "dry") == 0 || strcmp(what, "seal") == 0) {
        script_text_say(&s->text, "p:%s()\n", what);
        return true;
    }
    if (strcmp(what, "blot") == 0 && masked_say(s, what, &blot->place, ok)) {
        script_text_say(&s->text, ", %.17g, %.17g)\n", blot->part, blot->lift);
        return true;
    }
    if (strcmp(what, "resist") == 0 &&
        masked_say(s, resist->on ? "resist" : "unresist", &resist->place, ok)) {
        script_text_say(&s->text, ")\n");
        return true;
    }
    if (strcmp(what, "lift") == 0 && masked_say(s, what, &lift->place, ok)) {
        script_text_say(&s->text, ", %.17g)\n", lift->part);
        return true;
    }
    if (strcmp(what, "varnish") == 0 && masked_say(s, what, &varnish->place, ok)) {
        script_text_say(&s->text, ", %.17g)\n", varnish->amount);
        return true;
    }
    return false;
}

static bool operation_say(struct session *s, int number, const struct paper_moment *moment,
                          long steps)
{
    void *arguments;
    uint8_t *bytes;
    size_t count;
    bool ok = true;
    if (strcmp(moment->what, "step") == 0) {
        for (; steps > 0; steps -= 1000000)
            script_text_say(&s->text, "p:step(%ld)\n", steps < 1000000 ? steps : 1000000);
        return true;
    }
    if (paper_history_arguments(s->sheet, number, &arguments) != PAPER_OK)
        return failed("%s", paper_error());
    const bool said = operation_said(s, moment->what, arguments, &ok);
    paper_history_arguments_free(moment->what, arguments);
    if (said)
        return ok;
    if (paper_history_operation(s->sheet, number, &bytes, &count) != PAPER_OK)
        return failed("%s", paper_error());
    script_text_say(&s->text, "p:again(\"");
    script_text_base64(&s->text, bytes, count);
    script_text_say(&s->text, "\") -- %s\n", moment->what);
    free(bytes);
    return true;
}

/* ---- the file ---- */

static bool names_make(struct session *s, const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const size_t length = strlen(name);
    if (strlen(path) >= PATH_ROOM || length < 5 || strcmp(name + length - 4, ".lua") != 0 ||
        name[0] == '.' || name[0] == '-')
        return failed("%s: a script's name ends in .lua, and begins with neither a dot nor a "
                      "dash",
                      path);
    snprintf(s->folder, sizeof s->folder, "%.*s", (int)(name - path), path);
    snprintf(s->name, sizeof s->name, "%.*s", (int)(length - 4), name);
    return true;
}

static bool session_say(struct session *s, enum paper_show show)
{
    script_text_say(&s->text, "-- %s.lua: a session, as it was painted.\n", s->name);
    if (!paper_say(s))
        return false;
    script_text_say(&s->text, "local b1, b2, b3, b4, b5, b6, b7, b8\n");
    struct paper_moment moment;
    const long now = paper_sheet_steps(s->sheet);
    const int done = paper_history_done(s->sheet);
    for (int i = 0; i < done; i++) {
        if (!paper_history_moment(s->sheet, i, &moment))
            return failed("the history is shorter than it says");
        const long left = now - moment.time; /* the last may be undone in part */
        if (!operation_say(s, i, &moment, moment.steps < left ? moment.steps : left))
            return false;
    }
    script_text_say(&s->text, "p:frame(");
    char frame[PATH_ROOM + 8];
    snprintf(frame, sizeof frame, "%s.png", s->name);
    script_text_quoted(&s->text, frame);
    script_text_say(&s->text, ", {show = \"%s\", bits = 16})\n", script_shows[show]);
    return !s->text.short_of_memory || failed("no memory for a script");
}

static bool text_write(const struct session *s, const char *path)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return failed("%s: cannot write: %s", path, out.why);
    fwrite(s->text.at, 1, s->text.count, out.stream);
    return output_file_commit(&out) || failed("%s: cannot write: %s", path, out.why);
}

enum script_status script_session_write(struct paper_sheet *sheet, enum paper_show show,
                                        const char *path)
{
    struct session *s = calloc(1, sizeof *s);
    struct number_text_locale locale; /* Lua's decimal points */
    const bool plain = number_text_begin(&locale);
    bool good = s && plain ? paper_history_has(sheet) || failed("the sheet has no history")
                           : failed("no memory for a script");
    if (s) {
        s->sheet = sheet;
        s->config = paper_sheet_get_config(sheet);
        good = good && names_make(s, path) && session_say(s, show) && text_write(s, path);
        free(s->text.at);
    }
    free(s);
    if (plain)
        number_text_end(&locale);
    return good ? SCRIPT_OK : SCRIPT_FAILED;
}
