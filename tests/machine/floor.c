/* floor.c - a program of one floor of the machine and those below it: that it can be linked is the test. */
int main(void)
{
    return 0;
}
