/* near_links.h - a scan of one line that lies in several arrays, on the front end's own
 * thread: the same bits as of one array. */
#ifndef LUTETIA_MACHINE_NEAR_LINKS_H
#define LUTETIA_MACHINE_NEAR_LINKS_H

#include "ops/scan.h"

/* What one array has of the line, counted in the direction of the scan. */
struct link {
    struct line_scan scan;
    size_t at; /* of element begin, in its arrays */
    int begin, end;
};

/* Links in the order of the scan, one of the next after the last one's end. Elements are
 * combined in chunks; of floats these are the runs that machine_scan() specifies, links begin
 * where runs do, and there is more than one run. Before an element is another one in each array
 * of bits that is looked at backward. False: there is no memory. */
bool near_links_scan(struct crew *crew, int parts, const struct link *links, int count,
                     ptrdiff_t step, int chunk);

#endif
