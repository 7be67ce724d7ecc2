/* style.c - the parameters of words, and the presets: see word.h. */
#include "word.h"
#include "word_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define AT(member) .at = offsetof(struct dyn_word_style, member)

const struct control dyn_word_controls[] = {
    {"letter_mass", "kg", 0.001, 1000, 1, CONTROL_LOGARITHMIC, NULL,
     "of a letter: a quarter in each corner", AT(letter_mass)},
    {"side", "kg/s2", 0, 1e6, 900, CONTROL_LOGARITHMIC, NULL, "how strong a box's sides are",
     AT(side)},
    {"diagonal", "kg/s2", 0, 1e6, 600, CONTROL_LOGARITHMIC, NULL,
     "how strong a box's diagonals are: they keep its shape", AT(diagonal)},
    {"link", "kg/s2", 0, 1e6, 700, CONTROL_LOGARITHMIC, NULL,
     "how strong letters hold each other", AT(link)},
    {"hang", "kg/s2", 0, 1e6, 500, CONTROL_LOGARITHMIC, NULL,
     "how strong what a line hangs from is", AT(hang)},
    {"damping_ratio", "", 0, 2, 0.08, CONTROL_CENTRED, NULL,
     "how soon springs stop swinging: 1 is at once", AT(damping_ratio)},
    {"carry", "", 0, 20, 2, CONTROL_CENTRED, NULL,
     "how much stronger springs are for each line beyond the first", AT(carry)},
    {"letter_breaking", "", 0, 100, 0, CONTROL_LOGARITHMIC, NULL,
     "the strain at which sides and diagonals break; 0: never", AT(letter_breaking)},
    {"link_breaking", "", 0, 100, 0, CONTROL_LOGARITHMIC, NULL,
     "the strain at which links and what lines hang from break; 0: never", AT(link_breaking)},
    {"box", "", 0, 1, DYN_BOX_EM, CONTROL_CHOICE, "em ink",
     "what a letter's box is: advance by capital M, or its ink", AT(box)},
    {"tack", "", 0, 4, DYN_TACK_NONE, CONTROL_CHOICE, "none first ends top bottom",
     "which corners are tacked", AT(tack)},
    {"brace", "", 0, 3, DYN_BRACE_PARAGRAPH, CONTROL_CHOICE, "none crossed paragraph lines",
     "whether springs across keep letters and lines from sliding along each other", AT(brace)},
};
const int dyn_word_controls_count = sizeof dyn_word_controls / sizeof *dyn_word_controls;

const struct dyn_preset dyn_presets[] = {
    {"stiff", "letters keep their shapes, and the word is a board",
     "side=20000 diagonal=20000 link=20000 hang=20000 carry=1 damping_ratio=0.3 "
     "brace=crossed",
     false},
    {"jelly", "soft, and swings for long",
     "side=220 diagonal=130 link=160 damping_ratio=0.03 restitution=0.5 friction=0.6 carry=8 "
     "brace=crossed",
     false},
    {"pendulum", "hangs from its first letter",
     "side=6000 diagonal=6000 link=6000 damping_ratio=0.05 drag=0.01 tack=first "
     "carry=0",
     false},
    {"heavy", "hangs from its ends and sags",
     "letter_mass=4 side=2500 diagonal=1500 link=2200 damping_ratio=0.15 tack=ends "
     "carry=1",
     false},
    {"curtain", "hangs from all its upper corners, line from line, in a light wind",
     "letter_mass=0.3 side=250 diagonal=40 link=250 hang=250 damping_ratio=0.1 drag=0.08 "
     "wind_x=1.5 tack=top brace=lines carry=1",
     false},
    {"breakdown", "breaks between its letters where it is strained most, and its pieces go on",
     "side=2500 diagonal=2000 link=210 damping_ratio=0.06 link_breaking=1.4 restitution=0.45 "
     "friction=0.4 tack=ends brace=none carry=0",
     true},
};
const int dyn_presets_count = sizeof dyn_presets / sizeof *dyn_presets;

struct dyn_word_style dyn_word_style_usual(void)
{
    struct dyn_word_style style = {0};
    for (int i = 0; i < dyn_word_controls_count; i++)
        memcpy((char *)&style + dyn_word_controls[i].at, &dyn_word_controls[i].usual,
               sizeof(double));
    return style;
}

static const struct control *style_find(const char *name)
{
    for (int i = 0; i < dyn_word_controls_count; i++)
        if (strcmp(dyn_word_controls[i].name, name) == 0)
            return &dyn_word_controls[i];
    return NULL;
}

static enum dyn_status one_set(const char *name, const char *text, struct dyn_word_style *style,
                               struct dyn_world *world)
{
    const struct control *of_style = style_find(name);
    const struct control *control = of_style ? of_style : dyn_control_find(name);
    double value;
    enum dyn_status status =
        control ? dyn_control_parse(control, text, &value) : DYN_BAD_ARGUMENT;
    if (status == DYN_OK)
        status = dyn_control_write(control, of_style ? (void *)style : (void *)world, value);
    return status;
}

static enum dyn_status all_set(const char *sets, struct dyn_word_style *style,
                               struct dyn_world *world)
{
    enum dyn_status status = DYN_OK;
    char name[40], value[40];
    for (int used; status == DYN_OK && sscanf(sets, " %39[^=]=%39s%n", name, value, &used) == 2;
         sets += used)
        status = one_set(name, value, style, world);
    return status;
}

enum dyn_status dyn_preset_apply(const char *name, struct dyn_word_style *style,
                                 struct dyn_world *world)
{
    char all[200] = "";
    size_t length = 0;
    for (int i = 0; i < dyn_presets_count; i++) {
        if (strcmp(dyn_presets[i].name, name) == 0) {
            *style = dyn_word_style_usual();
            return all_set(dyn_presets[i].sets, style, world);
        }
        length +=
            (size_t)snprintf(all + length, sizeof all - length, " %s", dyn_presets[i].name);
    }
    return dyn_fail(DYN_BAD_ARGUMENT, "there is no preset '%.40s'; there are%s", name, all);
}

bool dyn_preset_collides(const char *name)
{
    for (int i = 0; i < dyn_presets_count; i++)
        if (strcmp(dyn_presets[i].name, name) == 0)
            return dyn_presets[i].collides;
    return false;
}
