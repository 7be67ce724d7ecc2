/* studio_settings.c - see studio_settings.h. */
#include "studio_settings.h"
#include "desk_words.h"

#include <math.h>

#define DEGREES 57.295779513082323 /* for one radian */

static double value_read(void *settings, int index)
{
    return ((const struct studio_settings *)settings)->value[index];
}

static unsigned value_write(void *settings, int index, double value)
{
    ((struct studio_settings *)settings)->value[index] = value;
    return STAGE_OK;
}

#define ROW(index_, name_, unit_, least_, most_, usual_, curve_, choices_, does_)              \
    [index_] = {.name = name_,                                                                 \
                .unit = unit_,                                                                 \
                .least = least_,                                                               \
                .most = most_,                                                                 \
                .usual = usual_,                                                               \
                .curve = CONTROL_##curve_,                                                     \
                .choices = choices_,                                                           \
                .does = does_,                                                                 \
                .read = value_read,                                                            \
                .write = value_write,                                                          \
                .at = index_}
#define PIGMENT(n, usual_)                                                                     \
    ROW(STUDIO_PIGMENT + n - 1, "pigment_" #n, "", 0, 2, usual_, LINEAR, NULL,                 \
        "how much of this pigment is in the dish: 0.5 is a usual wash")

const struct control studio_controls[STUDIO_SETTINGS] = {
    ROW(STUDIO_TOOL, "tool", "", 0, STUDIO_TOOLS - 1, STUDIO_TOOL_BRUSH, CHOICE,
        "brush water wash drop splatter salt blot lift mask unmask varnish type select stamp",
        "what the pointer does"),
    ROW(STUDIO_BRUSH, "brush", "", 0, 5, 0, CHOICE, "round flat mop rigger fan bristle",
        "the kind of brush; it sets the bristles below"),
    ROW(STUDIO_WIDTH, "width", "fibers", 1, 300, 24, LOGARITHMIC, NULL, "width of the tuft"),
    ROW(STUDIO_ANGLE, "angle", "degrees", -180, 180, 0, LINEAR, NULL,
        "how far the tuft's width is turned"),
    ROW(STUDIO_FOLLOWS, "follows", "", 0, 1, 0, SWITCH, NULL, "the tuft turns with the stroke"),
    ROW(STUDIO_POINT, "point", "", 0, 1, 0.75, LINEAR, NULL,
        "outer bristles are shorter: light pressure draws a thin line"),
    ROW(STUDIO_UNEVEN, "uneven", "", 0, 1, 0.25, LINEAR, NULL,
        "how far bristles differ in length and in what they give"),
    ROW(STUDIO_SPLAY, "splay", "", 0, 2, 0.25, LINEAR, NULL, "how far pressure spreads them"),
    ROW(STUDIO_BEND, "bend", "", 0, 2, 0.3, LINEAR, NULL, "how far they trail behind"),
    ROW(STUDIO_REACH, "reach", "widths", 1, 5000, 30, LOGARITHMIC, NULL,
        "about how far a full brush paints"),
    ROW(STUDIO_LOAD, "load", "", 0.01, 2, 0.7, LINEAR, NULL, "water that it lays on a fiber"),
    ROW(STUDIO_FLOW, "flow", "1/s", 1, 2000, 150, LOGARITHMIC, NULL,
        "how fast bristles and fibers exchange"),
    ROW(STUDIO_MIXING, "mixing", "", 0, 1, 0.15, LINEAR, NULL,
        "how much they exchange where both are as wet"),
    ROW(STUDIO_REFILL, "refill", "", 0, 1, 1, SWITCH, NULL,
        "the brush is dipped anew before each stroke"),
    ROW(STUDIO_PRESSURE, "pressure", "", 0.02, 1, 0.6, LINEAR, NULL,
        "of a mouse, or of a pen that does not tell it"),
    ROW(STUDIO_SPEED, "speed", "", 0, 1, 0.3, LINEAR, NULL,
        "how much a quick mouse presses less"),
    ROW(STUDIO_CURVE, "curve", "", 0.2, 5, 1, LOGARITHMIC, NULL,
        "a pen's pressure: below 1 a light hand presses more, above 1 less"),
    ROW(STUDIO_ERASER, "eraser", "", 0, 3, 0, CHOICE, "lift blot water unmask",
        "what a pen does that is held the other way round"),
    ROW(STUDIO_STEADY, "steady", "", 0, 1, 0, LINEAR, NULL,
        "the way follows the hand, smoother and later"),
    ROW(STUDIO_SHAPE, "shape", "", 0, 2, 0, CHOICE, "free line ellipse",
        "a way as the hand goes; from where it came down to where it is lifted, straight or as "
        "an ellipse"),
    ROW(STUDIO_SIZE, "size", "fibers", 0.5, 200, 8, LOGARITHMIC, NULL, "radius of a drop"),
    ROW(STUDIO_FADE, "fade", "", 0, 1, 0.2, LINEAR, NULL,
        "how much of the paint is left at the wash's end; 1: even"),
    ROW(STUDIO_DROPS, "drops", "", 1, 2000, 60, LOGARITHMIC, NULL, "how many are thrown"),
    ROW(STUDIO_SCATTER, "scatter", "fibers", 1, 1000, 80, LOGARITHMIC, NULL,
        "most fall within this radius"),
    ROW(STUDIO_GRAINS, "grains", "", 1, 5000, 60, LOGARITHMIC, NULL, "how many are strewn"),
    ROW(STUDIO_SALT, "strength", "", 0, 4, 1, LINEAR, NULL,
        "how far brine pushes pigments away"),
    ROW(STUDIO_SOAK, "soak", "", 0, 1, 0.8, LINEAR, NULL,
        "part of the water and of what swims in it that the cloth takes"),
    ROW(STUDIO_RUB, "rub", "", 0, 1, 0.6, LINEAR, NULL,
        "part of the loose pigment that the sponge takes"),
    ROW(STUDIO_GLOSS, "gloss", "", 0, 1, 0.8, LINEAR, NULL, "how thick the varnish is"),
    ROW(STUDIO_OUTLINE, "outline", "", 0, 2, 0, CHOICE, "rectangle ellipse lasso",
        "from corner to corner as a rectangle or an ellipse, or the way that the hand goes"),
    ROW(STUDIO_JOIN, "join", "", 0, 2, 0, CHOICE, "new add subtract",
        "it takes the place of what is selected (Shift: joins it, Alt: is taken out of it)"),
    ROW(STUDIO_STAMP_AS, "stamp_as", "", 0, 3, 0, CHOICE, "paint water fluid colours",
        "dark places take what is in the dish, its water alone, or masking fluid; or the "
        "picture "
        "is printed in its own colours by the sheet's pigments"),
    ROW(STUDIO_STAMP_SIZE, "stamp_size", "fibers", 4, 4000, 200, LOGARITHMIC, NULL,
        "length of the picture's longer side"),
    ROW(STUDIO_STAMP_ANGLE, "stamp_angle", "degrees", -180, 180, 0, LINEAR, NULL,
        "how far the picture is turned, counterclockwise"),
    ROW(STUDIO_STAMP_NEGATIVE, "negative", "", 0, 1, 0, SWITCH, NULL,
        "light places take it, and dark ones do not"),
    ROW(STUDIO_TYPE_SIZE, "type_size", "fibers", 4, 2000, 120, LOGARITHMIC, NULL,
        "size of the type: its em"),
    ROW(STUDIO_TYPE_ANGLE, "type_angle", "degrees", -180, 180, 0, LINEAR, NULL,
        "how far the type is turned, counterclockwise"),
    ROW(STUDIO_TYPE_COLUMN, "column", "fibers", 0, 4000, 0, LINEAR, NULL,
        "width to which lines are broken; 0: only where you begin a new one"),
    ROW(STUDIO_TYPE_LEADING, "leading", "sizes", 0, 4, 0, LINEAR, NULL,
        "from line to line; 0: as the font says"),
    ROW(STUDIO_TYPE_ALIGN, "align", "", 0, 4, 0, CHOICE, "start left right center justify",
        "how lines stand"),
    ROW(STUDIO_TYPE_SPRINGS, "springs", "", 0, 3, 0, CHOICE, "none stiff jelly breakdown",
        "letters hang on springs: take one, throw it, and the type is printed where it lands"),
    ROW(STUDIO_TYPE_SLIDE, "slide", "s", 0.1, 10, 2, LOGARITHMIC, NULL,
        "about how long thrown type slides and swings"),
    ROW(STUDIO_PAUSED, "paused", "", 0, 1, 0, SWITCH, NULL, "time on the paper stands still"),
    ROW(STUDIO_PACE, "pace", "steps/s", 1, 400, 60, LOGARITHMIC, NULL,
        "how fast time goes by on the paper"),
    ROW(STUDIO_TILT_X, "tilt_x", "", -0.95, 0.95, 0, LINEAR, NULL,
        "the board is tilted: water flows to the right"),
    ROW(STUDIO_TILT_Y, "tilt_y", "", -0.95, 0.95, 0, LINEAR, NULL,
        "the board is tilted: water flows down"),
    ROW(STUDIO_HUMIDITY, "drying", "", 0, 0.05, 0.0004, LOGARITHMIC, NULL,
        "water that dries in a step"),
    ROW(STUDIO_EDGE, "edge", "", 0, 200, 15, LINEAR, NULL,
        "how much faster the edge of what is wet dries: pigment is drawn there"),
    ROW(STUDIO_SHOW, "show", "", 0, STUDIO_SHOW_SETTLED, 1, CHOICE,
        "colour wet water relief mask swimming sunk settled",
        "colours alone, with the shine of wet paper, the water in gray, strong light on the "
        "relief, masking fluid; one pigment: what swims, has sunk in, has settled"),
    ROW(STUDIO_SHOWN, "shown", "", 1, PAPER_PIGMENTS_MAX, 1, LINEAR, NULL,
        "which pigment those views are of, in the dish's order"),
    ROW(STUDIO_WATER, "water", "", 0, 2, 0.8, LINEAR, NULL,
        "how much water is in the dish: more of it runs"),
    PIGMENT(1, 0.6),
    PIGMENT(2, 0),
    PIGMENT(3, 0),
    PIGMENT(4, 0),
    PIGMENT(5, 0),
    PIGMENT(6, 0),
    PIGMENT(7, 0),
    PIGMENT(8, 0),
    PIGMENT(9, 0),
    PIGMENT(10, 0),
    PIGMENT(11, 0),
    PIGMENT(12, 0),
    PIGMENT(13, 0),
    PIGMENT(14, 0),
    PIGMENT(15, 0),
    PIGMENT(16, 0),
};

void studio_settings_usual(struct studio_settings *settings)
{
    for (int i = 0; i < STUDIO_SETTINGS; i++)
        settings->value[i] = studio_controls[i].usual;
}

void studio_settings_kind(struct studio_settings *settings, int kind)
{
    struct paper_brush b = paper_brush_default();
    double *value = settings->value;
    b.width = value[STUDIO_WIDTH];
    paper_brush_of_kind(&b, paper_brush_kind(kind));
    value[STUDIO_BRUSH] = kind;
    value[STUDIO_POINT] = b.point;
    value[STUDIO_UNEVEN] = b.uneven;
    value[STUDIO_SPLAY] = b.splay;
    value[STUDIO_BEND] = b.bend;
    value[STUDIO_REACH] = b.reach / b.width;
    value[STUDIO_LOAD] = b.load;
    value[STUDIO_MIXING] = b.mixing;
}

struct paper_brush studio_settings_brush(const struct studio_settings *settings)
{
    const double *value = settings->value;
    struct paper_brush b = paper_brush_default();
    b.width = value[STUDIO_WIDTH];
    paper_brush_of_kind(&b, paper_brush_kind((int)value[STUDIO_BRUSH]));
    b.angle = value[STUDIO_ANGLE] / DEGREES;
    b.follows = value[STUDIO_FOLLOWS] != 0;
    b.point = value[STUDIO_POINT];
    b.uneven = value[STUDIO_UNEVEN];
    b.splay = value[STUDIO_SPLAY];
    b.bend = value[STUDIO_BEND];
    b.reach = fmin(1e6, fmax(1, value[STUDIO_REACH] * b.width));
    b.load = value[STUDIO_LOAD];
    b.flow = value[STUDIO_FLOW];
    b.mixing = value[STUDIO_MIXING];
    return b;
}

double studio_tuft_radius(double width, double point, double splay, double pressure)
{
    return width / 2 * (1 - point * (1 - pressure)) * (1 + splay * pressure);
}

void studio_settings_amounts(const struct studio_settings *settings,
                             double amount[1 + PAPER_PIGMENTS_MAX])
{
    amount[0] = settings->value[STUDIO_WATER];
    for (int i = 0; i < PAPER_PIGMENTS_MAX; i++)
        amount[1 + i] = settings->value[STUDIO_PIGMENT + i];
}

/* ---- tools ---- */

const struct studio_tool studio_tools[STUDIO_TOOLS] = {
    [STUDIO_TOOL_BRUSH] = {N_("Brush"), "b",
                           N_("Paint with bristles that carry what is in the dish: drag."),
                           STUDIO_BRUSH, STUDIO_SHAPE, true, true},
    [STUDIO_TOOL_WATER] = {N_("Clean water"), "w",
                           N_("The same brush with water alone: wets, softens edges, lifts."),
                           STUDIO_BRUSH, STUDIO_SHAPE, false, true},
    [STUDIO_TOOL_WASH] = {N_("Wash"), "a",
                          N_("A broad layer that fades: drag from one corner to the other."),
                          STUDIO_FADE, STUDIO_FADE, true, false},
    [STUDIO_TOOL_DROP] = {N_("Drop"), "d", N_("Let a drop of the dish fall: click."),
                          STUDIO_SIZE, STUDIO_SIZE, true, false},
    [STUDIO_TOOL_SPLATTER] = {N_("Splatter"), "x",
                              N_("Throw drops: click, or drag in the direction of the throw."),
                              STUDIO_DROPS, STUDIO_SCATTER, true, false},
    [STUDIO_TOOL_SALT] = {N_("Salt"), "s",
                          N_("Strew salt on wet paint, which flees from it: click."),
                          STUDIO_SCATTER, STUDIO_SALT, false, false},
    [STUDIO_TOOL_BLOT] = {N_("Blot"), "c", N_("A cloth takes water and wet paint: drag."),
                          STUDIO_SOAK, STUDIO_SOAK, false, true},
    [STUDIO_TOOL_LIFT] = {N_("Lift"), "l", N_("A damp sponge rubs dry paint off: drag."),
                          STUDIO_RUB, STUDIO_RUB, false, true},
    [STUDIO_TOOL_MASK] = {N_("Masking fluid"), "m",
                          N_("Where it is, the paper takes nothing: drag."), STUDIO_WIDTH,
                          STUDIO_WIDTH, false, true},
    [STUDIO_TOOL_UNMASK] = {N_("Rub masking fluid off"), "e",
                            N_("The paper takes paint again: drag."), STUDIO_WIDTH,
                            STUDIO_WIDTH, false, true},
    [STUDIO_TOOL_VARNISH] = {N_("Varnish"), "v", N_("A clear gloss, for good: drag."),
                             STUDIO_GLOSS, STUDIO_GLOSS, false, true},
    [STUDIO_TOOL_TYPE] = {N_("Type"), "t",
                          N_("Click where the type begins, and type. Control and Enter lets it "
                             "into the paper, Escape takes it away."),
                          STUDIO_TYPE_SIZE, STUDIO_TYPE_SLIDE, true, false},
    [STUDIO_TOOL_SELECT] =
        {N_("Selection"), "r",
         "Drag around a part of the sheet: what you do next stays inside, and "
         "no water flows across. A click selects nothing.",
         STUDIO_OUTLINE, STUDIO_JOIN, false, false},
    [STUDIO_TOOL_STAMP] = {N_("Stamp"), "i",
                           N_("A picture as paint, as water, as masking fluid or in its own "
                              "colours: choose one, or drop its file on the sheet, and click."),
                           STUDIO_STAMP_AS, STUDIO_STAMP_NEGATIVE, true, false},
};

const struct studio_tool *studio_tool_of(const struct studio_settings *settings)
{
    return &studio_tools[(int)settings->value[STUDIO_TOOL]];
}

enum studio_tool_number studio_settings_eraser(const struct studio_settings *settings)
{
    static const enum studio_tool_number tools[] = {STUDIO_TOOL_LIFT, STUDIO_TOOL_BLOT,
                                                    STUDIO_TOOL_WATER, STUDIO_TOOL_UNMASK};
    return tools[(int)settings->value[STUDIO_ERASER]];
}

bool studio_tool_has(enum studio_tool_number tool, int setting)
{
    const struct studio_tool *t = &studio_tools[tool];
    return (setting >= t->first && setting <= t->last) ||
           (t->swept &&
            (setting == STUDIO_WIDTH || setting == STUDIO_STEADY || setting == STUDIO_SHAPE));
}
