/* brush_internal.h - a sheet's brushes on the machine.
 *
 * The brushes of a sheet share VP sets of BRUSH_ROWS x 64, 128, 256 or 512 processors, each the
 * smallest that has its bristles, so that an exchange costs what the brush is: column b is
 * bristle b, and its rows are the places that it touches in one exchange. What a bristle holds
 * is the same in all rows of its column.
 *
 *              bristle 0   1   2   3  ...
 *     place 0        .     .   .   .        address of the fiber; contact; reach; how many
 *                    touch that fiber;
 *     place 1        .     .   .   .        in how many places the bristle touches
 *      ...
 *     held           w     w   w   w        in grains, doubles: whole numbers up to 2^53
 */
#ifndef LUTETIA_PAPER_BRUSH_INTERNAL_H
#define LUTETIA_PAPER_BRUSH_INTERNAL_H

#include "brush.h"
#include "model/model.h"

enum {
    BRUSH_ROWS = 32,
    BRUSH_PLACES = BRUSH_ROWS * PAPER_BRISTLES_MAX,
    BRUSH_TEMPORARIES = 10,
    BRUSH_SETS = 4, /* of PAPER_BRISTLES_MAX bristles, of half as many, ... */
    BRUSH_CLOUD = 2
};

/* Where a bristle is in the tuft at rest, and what it is like. */
struct sheet_bristle {
    double across, along; /* -1..1 */
    double shorter;       /* pressure from which it touches, 0..1 */
    double gives;         /* factor on the brush's load */
};

/* One exchange, as the front end lays it out: [row][bristle]. */
struct sheet_contacts {
    uint32_t address[BRUSH_PLACES];
    float contact[BRUSH_PLACES]; /* part of the way to equal levels, 0..1; 0: no touch */
    float reach[BRUSH_PLACES];   /* how far a dry bristle there reaches below the fiber */
    float sharers[BRUSH_PLACES]; /* places on the same fiber, 1.. */
    float places[BRUSH_PLACES];  /* of the same bristle, 1.. */
    float takes[BRUSH_PLACES];   /* factor on what the bristle would leave there, about 1 */
};

struct sheet_brush {
    bool there;
    struct paper_brush brush;
    struct sheet_bristle bristles[PAPER_BRISTLES_MAX];
    int set; /* of brushes->sets; held and gives are those of it */
    CM_field_id_t held[1 + PAPER_PIGMENTS_MAX], gives;
    CM_field_id_t held_in[BRUSH_SETS][1 + PAPER_PIGMENTS_MAX], gives_in[BRUSH_SETS];
    double full;      /* grains of water in a full bristle */
    double toward[2]; /* where it goes, a unit vector; of the present stroke */
};

/* A VP set for brushes of so many bristles or fewer, if there has been one. */
struct bristle_set {
    int bristles;
    CM_geometry_id_t geometry;
    CM_vp_set_id_t vp_set; /* 0: not made */
    CM_field_id_t address, contact, reach, sharers, places, gotten, sent, count;
    CM_field_id_t t[BRUSH_TEMPORARIES];
    CM_field_id_t give[1 + PAPER_PIGMENTS_MAX]; /* what each place gives, less what it takes */
};

struct sheet_brushes {
    struct bristle_set sets[BRUSH_SETS];
    struct sheet_contacts contacts;
    /* of each fiber, a number of this exchange: by how many places, or which of those touched;
     * 0 between exchanges */
    uint16_t *touched;
    struct sheet_brush brush[PAPER_BRUSHES_MAX];
};

/* Bristles and the sheet exchange where brushes->contacts says; call between paper_enter() and
 * paper_leave(). The sheet's VP set is current before and after. */
void sheet_brush_exchange(struct paper_sheet *p, const struct sheet_brushes *brushes,
                          const struct sheet_brush *brush);
/* The column or row at a place, of so many; around a torus. -1: it is beyond the sheet. */
int sheet_fiber_at(double at, int length, bool torus);

/* A bristle's place in an exchange (touches.c): the fibers that it lies over, and how much of
 * it lies over each. */
struct sheet_place {
    int fiber[4], part[4];
    int force; /* 0: it touches nothing */
    int held;  /* the same, less where the hair is lifted; may be below 0 */
};

/* force: 0..1. False: it is beyond the sheet. */
bool sheet_place_make(const struct paper_sheet *p, double x, double y, double force,
                      double lifted, struct sheet_place *place);
/* What fiber each place talks to (by row-major number, -1: none), how many places of full force
 * lie over that fiber, and with what force, less where hairs are lifted: the mean of them
 * weighed by their force, up to 1. */
struct sheet_dealt {
    int fibers[BRUSH_PLACES];
    double touch[BRUSH_PLACES], force[BRUSH_PLACES];
};
/* Writes b->contacts.sharers besides. */
void sheet_places_deal(struct sheet_brushes *b, const struct sheet_place *places,
                       struct sheet_dealt *dealt);
/* ---- a stroke on its way over the sheet (stroke.c): as many intervals as it takes steps
 * ---- */

struct sheet_going {
    struct paper_sheet *sheet;
    struct sheet_brush *own;
    const struct paper_stroke *stroke; /* who adds samples may move them */
    int cursor;
    int interval;       /* the next */
    uint64_t moment;    /* places along the way so far */
    double way, stride; /* of the tuft's middle so far, and from a place to the next: fibers */
    uint64_t seed;      /* for how its hairs part and lift */
};

void sheet_going_begin(struct sheet_going *g, struct paper_sheet *p,
                       const struct paper_stroke *stroke);
/* Intervals of the stroke as it is; and of those at its beginning that stay the same whatever
 * samples come. */
int sheet_going_intervals(const struct paper_stroke *stroke);
int sheet_going_settled(const struct paper_stroke *stroke);
/* Goes on until so many intervals have been done. Errors: MACHINE_FAILED (also: stopped),
 * NO_MEMORY. */
enum paper_status sheet_going_on(struct sheet_going *g, int until);
/* How far from a sample the brush may touch, fibers. */
double sheet_stroke_around(const struct paper_sheet *p, const struct paper_brush *brush);

/* Where the bristles are, and what they are like, from the brush's description. */
void sheet_brush_bristles_make(struct sheet_brush *brush);
/* How far a hair is aside of its place across the tuft, fibers; and how much of its force it is
 * lifted by, 0.. */
struct sheet_hair {
    double aside, lifted;
};
/* After so many fibers of a stroke's way, on a sheet that is so many times finer than its
 * stock. */
struct sheet_hair sheet_hair_at(const struct sheet_brush *brush, int number, uint64_t seed,
                                double way, double finer);

/* Numbers by chance, 0..1, from whatever distinguishes them. */
static inline double sheet_chance(uint64_t seed, uint64_t a, uint64_t b)
{
    uint64_t z = seed * UINT64_C(0x9e3779b97f4a7c15) + a * UINT64_C(0xd1342543de82ef95) +
                 b * UINT64_C(0xaf251af3b0f025b5) + UINT64_C(0x2545f4914f6cdd1d);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

#endif
