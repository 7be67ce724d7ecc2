/* boxes_parts.h - boxes of a sheet on the machine. */
#ifndef LUTETIA_PAPER_BOXES_PARTS_H
#define LUTETIA_PAPER_BOXES_PARTS_H

#include "model/boxes_find.h"
#include "model/model.h"

/* Why a fiber is not at rest: water and paint, or that alone which tells of wet ones around. */
enum { SHEET_ACTIVE_AROUND = 1, SHEET_ACTIVE_WET };
enum {
    PARTS_MOST = 2 * BOXES_MOST,
    WAIT_LEAST = 24 /* steps until a sheet that had no boxes is looked at again */
};
#define SHARE_MOST 0.75 /* of the sheet, in boxes */

/* A box on the machine. Of the sheet it has what a step needs. */
struct part {
    struct paper_sheet sheet;
    struct box box;
    /* fibers along its sides, on each axis (x, y), that look at what is beyond: 0 where it is
     * as long as the sheet */
    int rim[2];
    /* All that is wet or has paint that moves was in these fibers of the box so many steps ago;
     * without a width: nothing. In a step it spreads by one fiber. */
    struct box wet;
    int wet_steps;
    bool open;
    bool dressed; /* it has what only pictures need, too */
    bool lit;     /* ... and the relief */
    bool shown;   /* picture.c's */
};

struct sheet_boxes {
    struct part *parts[PARTS_MOST];
    bool confined; /* steps are done in the open parts */
    bool ahead;    /* they are newer than the sheet's own fields */
    int good;      /* steps for which they can be used */
    int wait;      /* steps until the sheet is looked at */
    int wait_next;
    double share;         /* of the sheet, that the last step computed */
    struct box expected;  /* fibers that will be touched are active, too; no width: none */
    struct paper_air air; /* by which they were made */
    void *words;          /* of the largest open part */
};

/* A part that is as large as the box and not open; a new one if there is none. Errors:
 * NO_MEMORY, MACHINE_FAILED. */
enum paper_status part_get(struct paper_sheet *p, const struct box *box, struct part **out);
/* Its fields from the sheet's; words: room for it. Between paper_enter() and paper_leave(). */
void part_fill(struct paper_sheet *p, struct part *part, void *words);
/* What pictures need of the sheet and steps do not, unless it is there. Between paper_enter()
 * and paper_leave(). */
void part_look(struct paper_sheet *p, struct part *part);
/* The box without its rim. */
void part_inside(const struct part *part, struct box *inside);
/* What is wet in the part, from active fibers: SHEET_ACTIVE_WET. Shape: the sheet's. */
void part_wet_find(const struct paper_sheet *p, struct part *part, const uint8_t *active);
/* Fibers of the sheet get wet. */
void part_wet_add(const struct paper_sheet *p, struct part *part, const struct box *at);
/* Another step: fibers of the sheet whose picture it may have changed; no width: none. */
void part_changed(struct part *part, struct box *changed);
/* Parts that are closed stay, as long as they and the open ones take no more than boxes may. */
void parts_closed_few(struct paper_sheet *p);
/* What open parts have changed, into the sheet's fields, if that has not been done. Between
 * paper_enter() and paper_leave(). */
void parts_give(struct paper_sheet *p);
void parts_close(struct sheet_boxes *b);
/* sheet_look(), and steps go on in the sheet's own fields, which have not changed by this. */
void parts_leave(struct paper_sheet *p);
/* Fibers of the open parts. */
double parts_area(const struct sheet_boxes *b);

#endif
