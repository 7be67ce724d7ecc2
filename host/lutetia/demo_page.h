/* demo_page.h - the demonstration page as a scene: the times at which inks are put on the
 * sheet, and the air.
 *
 *     struct demo_page *page;
 *     if (demo_page_create(&page) != PAPER_OK)
 *         die(paper_error());
 *     struct paper_sheet_config config = demo_page_config();
 *     paper_sheet_create(&config, &sheet);
 *     demo_page_begin(page, sheet);
 *     for (int step = 0; step < DEMO_STEPS; step++)
 *         demo_page_step(page, sheet, step);
 *     demo_page_destroy(page);
 */
#ifndef LUTETIA_DEMO_PAGE_H
#define LUTETIA_DEMO_PAGE_H

#include <sheet.h>

/* All events happen at multiples of DEMO_MOMENT steps. The machine evaluates the steps
 * between two events together, so equal intervals let it reuse its plan. */
enum { DEMO_WIDTH = 1600, DEMO_HEIGHT = 1200, DEMO_MOMENT = 8, DEMO_STEPS = 16 * DEMO_MOMENT };

struct paper_sheet_config demo_page_config(void);

struct demo_page;
/* Sets the type. Errors: BAD_FONT where none of the page's fonts is installed, NO_MEMORY. */
enum paper_status demo_page_create(struct demo_page **out);
void demo_page_destroy(struct demo_page *page); /* NULL is fine */

/* Puts on the dry letters and the marsh. Errors: as paper_sheet_put(). */
enum paper_status demo_page_begin(struct demo_page *page, struct paper_sheet *sheet);
/* Puts on what is due, and computes one cycle. Waits for the machine after every STEPS_AT_ONCE
 * cycles. Errors: as paper_sheet_put(), paper_sheet_step() and paper_sheet_finish(). */
enum paper_status demo_page_step(struct demo_page *page, struct paper_sheet *sheet, int step);

#endif
