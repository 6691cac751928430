static uint8_t line[600];
static size_t begin;
static size_t end;
static uint8_t answer[300];
static size_t answered;
static void discard(void)
{
    begin = end;
}
static void send(const uint8_t *bytes, size_t length)
{
    size_t at;
    (void)bytes;
    (void)length;
    line[end] = answer[0];
    ++end;
    for (at = 0U; at < answered; ++at) {
        line[end] = answer[at];
        ++end;
    }
}
static bool receive(uint8_t *byte)
{
    if (begin == end) {
        exit(9); /* the line stays silent */
    }
    *byte = line[begin];
    ++begin;
    return true;
}
