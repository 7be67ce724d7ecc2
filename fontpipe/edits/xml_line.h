/* xml_line.h - the line at which expat reads, for messages. Who includes it depends on
 * expat. */
#ifndef LUTETIA_FONT_XML_LINE_H
#define LUTETIA_FONT_XML_LINE_H

#include <expat.h>

/* From 1 on. Expat 2.9 has this function with another type, and warns of the old one. */
static inline unsigned long xml_line(XML_Parser parser)
{
#if XML_MAJOR_VERSION > 2 || (XML_MAJOR_VERSION == 2 && XML_MINOR_VERSION >= 9)
    return (unsigned long)XML_GetCurrentLineNumber64(parser);
#else
    return (unsigned long)XML_GetCurrentLineNumber(parser);
#endif
}

#endif
