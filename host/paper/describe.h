/* describe.h - the members of a sheet's descriptions and operations: names, ranges, units,
 * defaults, a row for each (events: members.h). Scripts read their fields by these rows, and
 * the documentation's tables are printed from them. */
#ifndef LUTETIA_PAPER_DESCRIBE_H
#define LUTETIA_PAPER_DESCRIBE_H

#include <members.h>

/* Of struct paper_air, paper_stock, paper_deckle, paper_pigment and its bands (sheet.h);
 * paper_brush, paper_dip, paper_stroke, paper_stroke_sample (brush.h); paper_salt,
 * paper_splatter, paper_wash, paper_print, paper_lift, paper_varnish (techniques.h);
 * event_blot, whose members paper_sheet_blot() takes one by one. The order and the kinds of
 * rows never change, because files depend on them. */
extern const struct members paper_air_members, paper_stock_members, paper_deckle_members,
    paper_pigment_members, paper_bands_members, paper_brush_members, paper_dip_members,
    paper_stroke_members, paper_sample_members, paper_salt_members, paper_splatter_members,
    paper_wash_members, paper_print_members, paper_lift_members, paper_varnish_members,
    paper_blot_members;

#endif
