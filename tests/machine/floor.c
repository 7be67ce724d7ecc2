/* floor.c - a program that links one floor of the machine and the floors below it. The test is
 * that it links. */
int main(void)
{
    return 0;
}
