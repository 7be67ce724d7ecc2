/* test_words.c - what another program reads in our PDF are the words that were set: where lines
 * go to the left, where letters change places, where words are divided. */
#include "../skip.h"
#include "support.h"

#include <drawing.h>
#include <page.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Words that are written apart; that are so long that programs read justified lines of them as
 * columns, so they are not justified. */
enum { TOGETHER = 0, APART = 1, RAGGED = 2 };

/* Articles of the Universal Declaration of Human Rights, and words with hyphens. */
static const struct {
    const char *language, *font, *text;
    int right_to_left;
    double width_px;
    int words;
} cases[] = {
    {"en", "DejaVuSerif",
     "A co-operation of the extraordinarily uncharacteristic conscience, notwithstanding the "
     "incomprehensible responsibilities and co-operation of it all, incomprehensibly "
     "responsible.",
     0, 130, APART},
    {"en", "EBGaramond12-Regular",
     "The office of a co-operative first finds the difficult affluent waffles, "
     "notwithstanding the self-sufficient ones.",
     0, 110, APART},
    {"he", "DejaVuSans",
     "אדם בעולם ועוד כמה מילים כדי שהשורה תישבר פעם אחת לפחות כל בני אדם נולדו בני חורין "
     "ושווים",
     1, 330, APART},
    {"ar", "DejaVuSans",
     "يولد جميع الناس أحرارا متساوين في الكرامة والحقوق وقد وهبوا عقلا وضميرا وعليهم أن يعامل "
     "بعضهم بعضا بروح الإخاء",
     1, 330, APART},
    {"hi", "DejaVuSans",
     "सभी मनुष्यों को गौरव और अधिकारों के मामले में जन्मजात स्वतन्त्रता और समानता प्राप्त है। उन्हें बुद्धि "
     "और अन्तरात्मा की देन प्राप्त है",
     0, 230, APART},
    {"th", "DejaVuSans", "มนุษย์ทั้งปวงเกิดมามีอิสระและเสมอภาคกันในเกียรติศักดิ์และสิทธิ ต่างมีเหตุผลและมโนธรรม",
     0, 230, TOGETHER},
    {"he", "DejaVuSans",
     "כל בני אדם נולדו בני חורין ושווים בערכם ובזכויותיהם. כולם חוננו בתבונה ובמצפון, לפיכך "
     "חובה עליהם "
     "לנהוג איש ברעהו ברוח של אחווה.",
     1, 330, APART},
    {"ru", "DejaVuSerif",
     "Все люди рождаются свободными и равными в своем достоинстве и правах. Они наделены "
     "разумом и "
     "совестью и должны поступать в отношении друг друга в духе братства.",
     0, 240, APART},
    {"ka", "DejaVuSans",
     "ყველა ადამიანი იბადება თავისუფალი და თანასწორი თავისი ღირსებითა და უფლებებით. მათ "
     "მინიჭებული "
     "აქვთ გონება და სინდისი",
     0, 300, APART},
    {"lo", "DejaVuSans",
     "ມະນຸດທຸກຄົນເກີດມາມີສິດເສລີພາບ ແລະ ສະເໝີໜ້າກັນໃນທາງກຽດຕິສັກ ແລະ ທາງສິດດ້ວຍມະນຸດມີສະຕິສຳປັດຊັນຍະ", 0, 300,
     TOGETHER},
    /* Vowel signs, points and joiners, which stand on letters or take no place. */
    {"ar", "DejaVuSans",
     "لمّا كان الاعتراف بالكرامة المتأصّلة في جميع أعضاء الأسرة البشرية أساسًا للحرّيّة والعدلِ "
     "والسلامِ",
     1, 330, APART},
    {"fa", "DejaVuSans",
     "از آنجا که عدم شناسائی حقوق بشر منتهی به اعمال "
     "وحشیانه‌ای "
     "گردیده "
     "است، "
     "متعهد "
     "شده‌اند "
     "که "
     "آزادی‌های اساسی را تأمین کنند",
     1, 330, APART},
    {"yi", "DejaVuSans", "אַלװעלטלעכע דעקלאַראַציע פֿון מענטשנרעכט און פֿרײַהײט", 1, 330, APART},
    /* Numbers in lines that go to the left, with signs and spaces behind them. */
    {"ar", "DejaVuSans",
     "قرار 217 ألف (د-3) في 10 ديسمبر 1948، مادة 12: بند ٢. عام 1948-1950 كان ٪50 من (1948) "
     "في",
     1, 330, APART},
    {"he", "DejaVuSans", "סעיפים 5, 7 ו 9. בשנת 1948 נאמר PDF ועוד 12 מילים: abc, def ו 3-4", 1,
     330, APART},
    /* Where a font has them. */
    {"km", "DejaVuSans",
     "មនុស្សទាំងអស់កើតមកមានសេរីភាព និងភាពស្មើៗគ្នាក្នុងសេចក្ដីថ្លៃថ្នូរនិងសិទ្ធិ។ "
     "មនុស្សគ្រប់រូបមានវិចារណញ្ញាណនិងមនសិការ ហើយត្រូវប្រព្រឹត្តចំពោះគ្នា",
     0, 300, TOGETHER},
    {"bn", "DejaVuSans",
     "সমস্ত মানুষ স্বাধীনভাবে সমান মর্যাদা এবং অধিকার নিয়ে জন্মগ্রহণ করে। তাঁদের বিবেক এবং বুদ্ধি আছে; "
     "সুতরাং "
     "সকলেরই একে অপরের প্রতি ভ্রাতৃত্বসুলভ মনোভাব নিয়ে আচরণ করা উচিত।",
     0, 330, APART},
    {"ta", "DejaVuSans",
     "மனிதப் பிறிவியினர் சகலரும் சுதந்திரமாகவே பிறக்கின்றனர்; அவர்கள் மதிப்பிலும், உரிமைகளிலும் சமமானவர்கள்",
     0, 360, APART | RAGGED},
    {"my", "DejaVuSans",
     "လူတိုင်းသည် တူညီ လွတ်လပ်သော ဂုဏ်သိက္ခာဖြင့် လည်းကောင်း၊ တူညီလွတ်လပ်သော အခွင့်အရေးများဖြင့် လည်းကောင်း၊ "
     "မွေးဖွားလာသူများ ဖြစ်သည်။",
     0, 300, RAGGED},
};

/* The text as PDF, in a narrow column, as pdftotext reads it. Owns: the caller frees it. */
static char *read_back(int n, bool *whole)
{
    struct page_text *t;
    struct page_style style = page_style_default();
    struct page_manner manner = page_manner_default();
    struct page_template page = {.width_px = 400, .height_px = 900, .frames_count = 1};
    struct font_layout layout;
    int roman, id;
    struct page_said said;
    char folder[] = "/tmp/lutetia-words-XXXXXX", path[64], command[128];
    page.frames[0] =
        (struct page_frame){.x = 20, .y = 20, .width = cases[n].width_px, .height = 860};
    style.font = cases[n].font;
    style.language = cases[n].language;
    manner.align = cases[n].words & RAGGED ? FONT_ALIGN_START : FONT_ALIGN_JUSTIFY;
    manner.hyphenate = true;
    manner.right_to_left = cases[n].right_to_left;
    assert_font(page_text_create(&t));
    assert_font(page_style_add(t, &style, &roman));
    assert_font(page_paragraph_add(t, 0, -1, cases[n].text, strlen(cases[n].text), roman,
                                   &manner, &id));
    assert_font(page_templates_set(t, &page, 1));
    assert_font(page_layout_said(t, 0, &layout, &said));
    assert_true(layout.glyphs[layout.glyphs_count - 1].line > 0);
    *whole = layout.missing_count == 0;
    const struct font_drawing d = {.width_px = 400,
                                   .height_px = 900,
                                   .text = said.utf8,
                                   .bytes = said.bytes,
                                   .passages = said.passages,
                                   .passages_count = said.passages_count};
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/words.pdf", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_font(font_drawing_pdf(&d, &layout, NULL, 0, 0, file));
    fclose(file);
    snprintf(command, sizeof command, "pdftotext -enc UTF-8 %s -", path);
    FILE *pipe = popen(command, "r");
    char *out = calloc(1, 20000);
    assert_non_null(pipe);
    assert_non_null(out);
    assert_true(fread(out, 1, 19999, pipe) > 0);
    assert_int_equal(pclose(pipe), 0);
    unlink(path);
    rmdir(folder);
    page_said_finish(&said);
    font_layout_finish(&layout);
    page_text_destroy(t);
    return out;
}

/* The letters, one space for what is white between them (spaced) or none; without signs of
 * direction and joiners, which programs put in. */
static void tidy(const char *text, bool spaced, char *out)
{
    bool gap = false, any = false;
    for (const char *at = text, *end = text + strlen(text); at < end;) {
        const char *from = at;
        uint32_t c;
        font_utf8_next(&at, end, &c);
        if ((c >= 0x200e && c <= 0x200f) || (c >= 0x202a && c <= 0x202e) || c == 0x2060)
            continue;
        if (c <= ' ') {
            gap = true;
            continue;
        }
        if (gap && any && spaced)
            *out++ = ' ';
        gap = false;
        any = true;
        memcpy(out, from, (size_t)(at - from));
        out += at - from;
    }
    *out = '\0';
}

/* As tidy() leaves it, but what is behind a hyphen at a line's end goes on: "co-" and
 * "operation". */
static void hyphens_join(char *text)
{
    for (char *at; (at = strstr(text, "- "));)
        memmove(at + 1, at + 2, strlen(at + 2) + 1);
}

static void words_come_back(void **state)
{
    (void)state;
    if (system("command -v pdftotext >/dev/null"))
        skip_because("pdftotext is not installed");
    for (int n = 0; n < (int)(sizeof cases / sizeof *cases); n++) {
        static char want[20000], have[20000];
        bool whole;
        char *got = read_back(n, &whole);
        tidy(cases[n].text, cases[n].words & APART, want);
        tidy(got, cases[n].words & APART, have);
        hyphens_join(have);
        if (whole && strcmp(want, have) != 0)
            fail_msg("case %d (%s): set\n%s\nread\n%s", n, cases[n].language, want, have);
        free(got);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(words_come_back)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
