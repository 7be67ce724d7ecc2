/* studio_springs.c - see studio_springs.h. A unit of the world is an em. */
#include "studio_springs.h"
#include "studio_session_internal.h"

#include <collide.h>
#include <edits.h>
#include <energy.h>
#include <hand.h>
#include <step.h>
#include <word_gray.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TICK_S (1.0 / 240)
#define LONGEST_S 0.1
/* Springs on the move lose half of what sliding loses: of their speed a fiftieth is left after
 * so many times the drag's time. */
#define SLID 7.8
#define PULL 150.0      /* of the hand's spring: kg/s2 for each kg of the word */
#define SLOW 0.02       /* ems a second, RMS: it does not seem to move */
#define QUIET_S 0.15    /* so long */
#define SLIDES_MOST 6.0 /* so many times slide_s: where edges squeeze it, it is never slow */
#define CORNERS 4.0     /* masses of a letter */
#define PULL_MOST 1e5   /* of a spring's constant */

struct studio_springs {
    struct font_face *face;
    struct font_shaper *shaper;
    struct font_painter *painter;
    struct dyn_network *network;
    struct dyn_word *word;
    struct dyn_view view;
    double width, height; /* the sheet, fibers */
    double mass_kg;       /* the word's */
    bool collides, held, thrown;
    int mass;                 /* the one that is held */
    double apart_x, apart_y;  /* the held mass from the hand, ems */
    double left_s;            /* of time that has gone by, and was not stepped */
    double quiet_s, thrown_s; /* how long it has been slow; since it was let go */
    double slide_s;           /* it slides about so long */
};

static enum paper_status font_failed(enum font_status status)
{
    return studio_session_failed(status == FONT_NO_MEMORY ? PAPER_NO_MEMORY : PAPER_BAD_FONT,
                                 "%s", font_error());
}

static enum paper_status springs_failed(enum dyn_status status)
{
    return studio_session_failed(status == DYN_NO_MEMORY ? PAPER_NO_MEMORY : PAPER_BAD_TEXT,
                                 "%s", dyn_error());
}

/* ---- making ---- */

/* The choices of STUDIO_TYPE_SPRINGS. NULL: none. */
static const char *preset_of(const struct studio_settings *settings)
{
    static const char *const names[] = {NULL, "stiff", "jelly", "breakdown"};
    return names[(int)settings->value[STUDIO_TYPE_SPRINGS]];
}

static enum paper_status fonts_open(struct studio_springs *s, const char *font)
{
    struct font_painter_def def = font_painter_def_default();
    def.filter = "box"; /* as type that is set */
    enum font_status status = font_edits_open(font, 0, false, &s->face);
    if (status == FONT_OK)
        status = font_shaper_create(s->face, &s->shaper);
    if (status == FONT_OK)
        status = font_painter_create(&def, &s->painter);
    return status == FONT_OK ? PAPER_OK : font_failed(status);
}

/* The sheet as a world: its edges are walls, and the paper slows what slides. */
static void world_make(const struct studio_springs *s, const struct studio_settings *settings,
                       double letter_mass, struct dyn_world *world)
{
    const double size = s->view.scale;
    world->gravity = 0;
    world->drag = letter_mass / CORNERS * SLID / settings->value[STUDIO_TYPE_SLIDE];
    world->friction = 0;
    world->floor_on = world->ceiling_on = world->left_on = world->right_on = 1;
    world->floor = -s->height / size;
    world->ceiling = 0;
    world->left = 0;
    world->right = s->width / size;
}

static void def_make(const struct studio_springs *s, const struct studio_type *type,
                     const struct studio_settings *settings, struct dyn_word_def *def)
{
    static const enum font_align aligns[] = {FONT_ALIGN_START, FONT_ALIGN_LEFT,
                                             FONT_ALIGN_RIGHT, FONT_ALIGN_CENTER,
                                             FONT_ALIGN_JUSTIFY};
    const double size = s->view.scale, *value = settings->value;
    def->text = type->text;
    def->shaper = s->shaper;
    def->size = 1;
    def->x = type->x / size;
    def->y = -type->y / size;
    def->width = value[STUDIO_TYPE_COLUMN] / size;
    def->align = aligns[(int)value[STUDIO_TYPE_ALIGN]];
    def->features = type->features && type->features[0] ? type->features : NULL;
}

static enum paper_status word_make(struct studio_springs *s, const struct studio_type *type,
                                   const struct studio_settings *settings)
{
    const char *preset = preset_of(settings);
    const double angle = settings->value[STUDIO_TYPE_ANGLE] * M_PI / 180;
    struct dyn_word_def def = dyn_word_def_usual();
    def_make(s, type, settings, &def);
    const double path[2][2] = {{def.x, def.y}, {def.x + cos(angle), def.y + sin(angle)}};
    if (settings->value[STUDIO_TYPE_ANGLE] != 0) {
        def.path = path;
        def.path_count = 2;
    }
    enum dyn_status status = dyn_network_create(&s->network);
    if (status != DYN_OK)
        return springs_failed(status);
    struct dyn_world world = *dyn_network_world(s->network);
    status = dyn_preset_apply(preset, &def.style, &world);
    def.style.tack = DYN_TACK_NONE;
    world_make(s, settings, def.style.letter_mass, &world);
    if (status == DYN_OK)
        status = dyn_network_world_set(s->network, &world);
    if (status == DYN_OK)
        status = dyn_word_create(s->network, &def, &s->word);
    if (status != DYN_OK)
        return springs_failed(status);
    s->collides = dyn_preset_collides(preset);
    s->mass_kg = def.style.letter_mass * dyn_word_letters_count(s->word);
    return PAPER_OK;
}

enum paper_status studio_springs_create(const struct studio_type *type,
                                        const struct studio_settings *settings, double width,
                                        double height, struct studio_springs **out)
{
    *out = NULL;
    if (!preset_of(settings))
        return studio_session_failed(PAPER_BAD_ARGUMENT, "this type has no springs");
    struct studio_springs *s = calloc(1, sizeof *s);
    if (!s)
        return studio_session_failed(PAPER_NO_MEMORY, "not enough memory for springy type");
    s->view.scale = settings->value[STUDIO_TYPE_SIZE];
    s->slide_s = settings->value[STUDIO_TYPE_SLIDE];
    s->width = width;
    s->height = height;
    enum paper_status status = fonts_open(s, type->font);
    if (status == PAPER_OK)
        status = word_make(s, type, settings);
    if (status == PAPER_OK)
        *out = s;
    else
        studio_springs_destroy(s);
    return status;
}

void studio_springs_destroy(struct studio_springs *s)
{
    if (!s)
        return;
    dyn_word_destroy(s->word);
    dyn_network_destroy(s->network);
    font_painter_destroy(s->painter);
    font_shaper_destroy(s->shaper);
    font_face_close(s->face);
    free(s);
}

/* ---- a hand ---- */

static void world_place(const struct studio_springs *s, double x, double y, double at[2])
{
    at[0] = x / s->view.scale;
    at[1] = -y / s->view.scale;
}

bool studio_springs_take(struct studio_springs *s, double x, double y)
{
    double at[2], corners[4][2];
    int nearest = 0;
    world_place(s, x, y, at);
    const int letter = dyn_word_letter_at(s->word, s->network, at[0], at[1], NULL);
    if (letter < 0)
        return false;
    dyn_word_quad(s->word, s->network, letter, corners);
    for (int i = 1; i < 4; i++)
        if (hypot(corners[i][0] - at[0], corners[i][1] - at[1]) <
            hypot(corners[nearest][0] - at[0], corners[nearest][1] - at[1]))
            nearest = i;
    studio_springs_let_go(s);
    s->mass = dyn_word_letter(s->word, letter)->mass[nearest];
    s->apart_x = corners[nearest][0] - at[0];
    s->apart_y = corners[nearest][1] - at[1];
    s->held = dyn_pull_begin(s->network, s->mass, corners[nearest][0], corners[nearest][1],
                             fmin(PULL * s->mass_kg, PULL_MOST)) == DYN_OK;
    return s->held;
}

void studio_springs_move(struct studio_springs *s, double x, double y)
{
    double at[2];
    world_place(s, x, y, at);
    if (s->held) /* what is no place of the world leaves it where it is */
        dyn_pull_move(s->network, s->mass, at[0] + s->apart_x, at[1] + s->apart_y);
}

void studio_springs_let_go(struct studio_springs *s)
{
    if (!s->held)
        return;
    dyn_pull_end(s->network, s->mass);
    s->held = false;
    s->thrown = true;
    s->quiet_s = s->thrown_s = 0;
}

bool studio_springs_held(const struct studio_springs *s)
{
    return s->held;
}

bool studio_springs_rests(const struct studio_springs *s)
{
    return s->thrown && !s->held &&
           (s->quiet_s > QUIET_S || s->thrown_s > SLIDES_MOST * s->slide_s);
}

/* ---- time ---- */

static bool is_slow(const struct studio_springs *s)
{
    const struct dyn_energy e = dyn_network_energy(s->network);
    return sqrt(2 * e.motion / s->mass_kg) < SLOW;
}

void studio_springs_step(struct studio_springs *s, double seconds)
{
    const struct dyn_word *word = s->word;
    s->left_s = fmin(s->left_s + fmax(seconds, 0), LONGEST_S);
    for (; s->left_s >= TICK_S; s->left_s -= TICK_S) {
        if (dyn_network_step(s->network, TICK_S, 1) != DYN_OK)
            return; /* no memory: it stays where it is, and may be printed there */
        if (s->collides)
            dyn_words_collide(s->network, &word, 1, NULL);
        s->quiet_s = is_slow(s) ? s->quiet_s + TICK_S : 0;
        s->thrown_s += TICK_S;
    }
}

/* ---- as a screen ---- */

struct box {
    int x0, y0, x1, y1;
};

static int clamped(int value, double least, double most)
{
    return value < least ? (int)least : value > most ? (int)most : value;
}

static struct box on_sheet(const struct studio_springs *s, const struct font_gray *gray)
{
    return (struct box){clamped(gray->left_px, 0, s->width),
                        clamped(gray->top_px, 0, s->height),
                        clamped(gray->left_px + gray->width_px, 0, s->width),
                        clamped(gray->top_px + gray->height_px, 0, s->height)};
}

/* For each letter that is on the sheet: extends the box, or draws onto the screen. */
static enum paper_status letters_go(struct studio_springs *s, struct box *box,
                                    struct paper_screen *screen)
{
    for (int i = 0; i < dyn_word_glyphs_count(s->word); i++) {
        struct font_point to[4];
        const struct font_gray *gray;
        dyn_word_corners(s->word, s->network, i, &s->view, to);
        const enum font_status status =
            dyn_word_gray(s->word, i, &s->view, to, s->painter, &gray);
        if (status == FONT_NO_MEMORY)
            return font_failed(status);
        if (status != FONT_OK || gray->width_px == 0)
            continue; /* turned over, so that no side is seen */
        const struct box of = on_sheet(s, gray);
        if (screen)
            dyn_gray_over(gray, screen->gray, box->x0, box->y0, screen->width_px,
                          screen->height_px);
        else if (of.x1 > of.x0 && of.y1 > of.y0)
            *box = (struct box){
                of.x0 < box->x0 ? of.x0 : box->x0, of.y0 < box->y0 ? of.y0 : box->y0,
                of.x1 > box->x1 ? of.x1 : box->x1, of.y1 > box->y1 ? of.y1 : box->y1};
    }
    return PAPER_OK;
}

enum paper_status studio_springs_screen(struct studio_springs *s, struct paper_screen *screen,
                                        int *x, int *y)
{
    struct box box = {(int)s->width, (int)s->height, 0, 0};
    *screen = (struct paper_screen){0};
    enum paper_status status = letters_go(s, &box, NULL);
    if (status != PAPER_OK || box.x1 <= box.x0 || box.y1 <= box.y0)
        return status;
    screen->width_px = box.x1 - box.x0;
    screen->height_px = box.y1 - box.y0;
    screen->gray = calloc((size_t)screen->width_px, (size_t)screen->height_px);
    if (!screen->gray)
        return studio_session_failed(PAPER_NO_MEMORY, "not enough memory for springy type");
    *x = box.x0;
    *y = box.y0;
    return letters_go(s, &box, screen);
}
