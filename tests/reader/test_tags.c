/* test_tags.c - tags of HTML in documents, beside what is expected of each. */
#include <reader_document.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include "said.h"
#include "without_library.h"

/* Tags that have a meaning which can be shown are read so. */
static void tags_mean_what_they_say(void **state)
{
    (void)state;
    blocks_are("H<sub>2</sub>O, x<sup>2</sup>, <kbd>Ctrl</kbd>+<b>B <i>c</i></b> <u>d</u>\n",
               "p H_2_O, x+2+, `Ctrl`+!B !*!c!* d\n");
    blocks_are("a <b>b\n\nc </i> d <x-y>e</x-y> <script>f</script>\n",
               "p a !b!\np c d `<x-y>`e`</x-y>` `<script>`f`</script>`\n");
    blocks_are("<p align=\"center\">\n  <img src=\"a/b.png\" alt=\"A &amp; B\" "
               "width=300>\n</p>\n\nc\n",
               "picture c <a/b.png> *A & B*\np c\n");
    blocks_are(
        "<h1 align=center><a name=x></a>T <em>i</em></h1>\n<p align=\"right\">\nOne &lt;two\n"
        "three<br>four</p>\n<hr>\n\n[#](#x)\n",
        "h1 c T *i*\np r One <two three\nfour\nrule \np [T ](#x)*[i]*(#x)\n");
    blocks_are(
        "<div align=\"center\">\n\n# A\n\n- b\n\n  <center>\n\n  c\n\nd\n\n</div>\n\ne\n",
        "h1 c A\np- \xe2\x80\xa2 c b\np- c c\np c d\np e\n");
    blocks_are("<details>\n<summary>More <code>x</code></summary>\n\nHid *den*\n\n- "
               "a\n\n</details>\nb\n",
               "p- \xe2\x96\xbe !More !!`x`!\np- Hid *den*\np-- \xe2\x80\xa2 a\np b\n");
    blocks_are("<details></details>\n\na\n", "p- \xe2\x96\xbe \np a\n");
    blocks_are("<ol><li>a<li>b<ul><li>c</ul></ol><blockquote>d</blockquote>\n",
               "p- 1. a\np- 2. b\np-- \xe2\x80\xa2 c\np> d\n");
    blocks_are("<img align=\"right\" src=\"a.png\" width=\"30%\">\nWords.\n",
               "picture @2:30 <a.png> \np Words.\n");
    blocks_are("# <img align=left src='a.png'> T\n\n## <img src=\"b/i.png\"> U\n",
               "picture @1:0 <a.png> \nh1 T\nh2 *[<|i.png|>]*(b/i.png) U\n");
    blocks_are("<a href=\"x.md\"><img src=\"a.png\" alt=A></a> <img src=\"b.png\">\n",
               "picture <a.png> *[A]*(x.md)\npicture <b.png> \n");
    blocks_are(
        "<a href=\"y\"><img src=\"https://h/b.svg\" alt=\"Build\"></a>\n<img src=c.jpg>\n",
        "p *[Build]*(y) *[c.jpg]*(c.jpg)\n");
    blocks_are("<table>\n<tr><th>a<th align=right>b\n<tr><td>c</td> <td>d <b>e</b>\n"
               "<td><img src=f.png>\n<tr><th>g\n</table>\n\nh\n",
               "row !a!\t!b!\nrow c\td !e!\t*[<|f.png|>]*(f.png)\nrow !g!\np h\n");
    blocks_are("<table><tr><td><p>a</td></tr></table>\n",
               "html `<table><tr><td><p>a</td></tr></table>`\n");
    blocks_are("<p><table><tr><td>a</table>\n\nb\n", "row a\np b\n");
    blocks_are("<div align=center><video>\n\na\n\n</video></div>\n\nb\n",
               "html `<div align=center><video>`\np c a\np c `</video>`\np b\n");
    blocks_are("[![a](https://h/a.svg)](b) ![c](https://h/c.svg) <img src=d.svg alt=\"\">e\n",
               "p *[a]*(b) *[c]*(https://h/c.svg) e\n");
    blocks_are("> <div align=center>\n>\n> a\n\nb\n", "p> c a\np b\n");
    blocks_are(
        "<p onclick=\"x()\">a &unknown; &#65;&#x42; <a href=\"javascript:x\">b</a></p>\n",
        "p a &unknown; AB [b](javascript:x)\n");
    blocks_are("a[^n]\n\n[^n]: b\n\n    ![c](d.png)\n",
               "p a^1^\nnote :n\np b\npicture <d.png> *c*\n");
    blocks_are("a ![*b* `c`](d.png) ![](e/f.png) ![g](h.jpg)\n",
               "p a *[<|b c|>]*(d.png) *[<|f.png|>]*(e/f.png) *[g]*(h.jpg)\n");
    blocks_are("<p>\n<!-- <b> -->1 < 2\n</p>\n<div", "p 1 < 2\np <div\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(tags_mean_what_they_say)};
    return without_library() ? 77 : cmocka_run_group_tests(tests, NULL, NULL);
}
