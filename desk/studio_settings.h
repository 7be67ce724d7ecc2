/* studio_settings.h - all that can be set in the studio, as controls (control_table.h), and its
 * tools.
 *
 *     struct studio_settings settings;
 *     studio_settings_usual(&settings);
 *     stage_control_write(&studio_controls[STUDIO_WIDTH], &settings, 30);
 *     const struct studio_tool *tool = studio_tool_of(&settings);
 *
 * The window's sliders, the keys, the recorded input and the tests read the same two tables.
 * Lengths are fibers.
 *
 * Threads: each has settings of its own; the tables are constant. */
#ifndef LUTETIA_STUDIO_SETTINGS_H
#define LUTETIA_STUDIO_SETTINGS_H

#include <brush.h>
#include <control_table.h>

#include <stdbool.h>

enum studio_setting {
    STUDIO_TOOL,
    /* the brush */
    STUDIO_BRUSH,
    STUDIO_WIDTH,
    STUDIO_ANGLE,
    STUDIO_FOLLOWS,
    STUDIO_POINT,
    STUDIO_UNEVEN,
    STUDIO_SPLAY,
    STUDIO_BEND,
    STUDIO_REACH,
    STUDIO_LOAD,
    STUDIO_FLOW,
    STUDIO_MIXING,
    STUDIO_REFILL,
    /* the hand */
    STUDIO_PRESSURE,
    STUDIO_SPEED,
    STUDIO_CURVE,
    STUDIO_ERASER,
    STUDIO_STEADY,
    STUDIO_SHAPE,
    /* other tools */
    STUDIO_SIZE,
    STUDIO_FADE,
    STUDIO_DROPS,
    STUDIO_SCATTER,
    STUDIO_GRAINS,
    STUDIO_SALT,
    STUDIO_SOAK,
    STUDIO_RUB,
    STUDIO_GLOSS,
    STUDIO_OUTLINE,
    STUDIO_JOIN,
    STUDIO_STAMP_AS,
    STUDIO_STAMP_SIZE,
    STUDIO_STAMP_ANGLE,
    STUDIO_STAMP_NEGATIVE,
    /* type */
    STUDIO_TYPE_SIZE,
    STUDIO_TYPE_ANGLE,
    STUDIO_TYPE_COLUMN,
    STUDIO_TYPE_LEADING,
    STUDIO_TYPE_ALIGN,
    STUDIO_TYPE_SPRINGS,
    STUDIO_TYPE_SLIDE,
    /* time and air */
    STUDIO_PAUSED,
    STUDIO_PACE,
    STUDIO_TILT_X,
    STUDIO_TILT_Y,
    STUDIO_HUMIDITY,
    STUDIO_EDGE,
    STUDIO_SHOW,
    STUDIO_SHOWN,
    /* what is in the dish */
    STUDIO_WATER,
    STUDIO_PIGMENT, /* the first of PAPER_PIGMENTS_MAX, in the order of the sheet's */
    STUDIO_SETTINGS = STUDIO_PIGMENT + PAPER_PIGMENTS_MAX
};

/* Choices of STUDIO_STAMP_AS, STUDIO_SHAPE and STUDIO_SHOW. */
enum studio_stamp_as {
    STUDIO_STAMP_PAINT, /* what is in the dish */
    STUDIO_STAMP_WATER, /* its water alone */
    STUDIO_STAMP_FLUID,
    STUDIO_STAMP_COLOURS /* its own, of the sheet's pigments */
};
enum studio_shape { STUDIO_SHAPE_FREE, STUDIO_SHAPE_LINE, STUDIO_SHAPE_ELLIPSE };
enum studio_show {
    STUDIO_SHOW_COLOR,
    STUDIO_SHOW_WET,
    STUDIO_SHOW_WATER,
    STUDIO_SHOW_RELIEF,
    STUDIO_SHOW_MASK,
    STUDIO_SHOW_SWIMMING, /* these three: of the pigment STUDIO_SHOWN */
    STUDIO_SHOW_SUNK,
    STUDIO_SHOW_SETTLED
};

struct studio_settings {
    double value[STUDIO_SETTINGS];
};
extern const struct control studio_controls[STUDIO_SETTINGS];
void studio_settings_usual(struct studio_settings *settings);

/* The bristles' settings become those of a kind of brushes, from 0 as in the control's
 * choices. */
void studio_settings_kind(struct studio_settings *settings, int kind);
/* The brush that the settings describe. */
struct paper_brush studio_settings_brush(const struct studio_settings *settings);
/* Half the width of a tuft under a pressure: outer bristles touch last, pressure spreads
 * them. */
double studio_tuft_radius(double width, double point, double splay, double pressure);
/* Water and pigments as they are put: the dish. */
void studio_settings_amounts(const struct studio_settings *settings,
                             double amount[1 + PAPER_PIGMENTS_MAX]);

enum studio_tool_number {
    STUDIO_TOOL_BRUSH,
    STUDIO_TOOL_WATER,
    STUDIO_TOOL_WASH,
    STUDIO_TOOL_DROP,
    STUDIO_TOOL_SPLATTER,
    STUDIO_TOOL_SALT,
    STUDIO_TOOL_BLOT,
    STUDIO_TOOL_LIFT,
    STUDIO_TOOL_MASK,
    STUDIO_TOOL_UNMASK,
    STUDIO_TOOL_VARNISH,
    STUDIO_TOOL_TYPE,
    STUDIO_TOOL_SELECT,
    STUDIO_TOOL_STAMP,
    STUDIO_TOOLS
};

struct studio_tool {
    const char *name;
    const char *key;  /* a letter */
    const char *does; /* a sentence: what it does and how */
    int first, last;  /* the settings that are its own */
    bool inked;       /* it puts what is in the dish */
    bool swept;       /* it works along the way of the hand, as wide as STUDIO_WIDTH */
};
extern const struct studio_tool studio_tools[STUDIO_TOOLS];
const struct studio_tool *studio_tool_of(const struct studio_settings *settings);
/* The tool of a pen's other end. */
enum studio_tool_number studio_settings_eraser(const struct studio_settings *settings);
/* Whether the tool has this setting. */
bool studio_tool_has(enum studio_tool_number tool, int setting);

#endif
