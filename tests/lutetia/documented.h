/* documented.h - commands as documents give them, for tests that make the documents' pictures
 * again. */
#ifndef LUTETIA_TEST_DOCUMENTED_H
#define LUTETIA_TEST_DOCUMENTED_H

/* The last command that begins so ("lutetia spring ") before these words in the document
 * ("--still word.png"), to the end of its line; lines are joined at backslashes. The document
 * is below the folder. Valid until the next call. Ends the test where there is none. */
char *documented_command(const char *folder, const char *document, const char *begins,
                         const char *wanted);

/* Splits a command into words at blanks, outside double quotes, in its own text. Returns how
 * many. */
int documented_words(char *text, const char **words, int most);

#endif
