/* script_brush.h - a script's brush, shared with strokes. */
#ifndef LUTETIA_SCRIPT_BRUSH_H
#define LUTETIA_SCRIPT_BRUSH_H

#include "script_paper.h"

/* Its user value is the paper. */
struct script_brush {
    int number;
    double width;
    bool dipped; /* into anything, or rinsed */
};

#endif
