#include <stdio.h>
#include "fieldscribe.h"
int main(void)
{
    long long number, num, den, offset, parts;
    while (scanf("%lld %lld %lld %lld %lld", &number, &num, &den, &offset, &parts) == 5) {
        const fieldscribe_rule rule = fieldscribe_rule_of(num, den, offset, parts);
        int64_t raw = 0;
        if (fieldscribe_apply_rule(&rule, number, 1, &raw)) {
            printf("%lld\n", (long long)raw);
        } else {
            printf("-\n");
        }
    }
    return 0;
}
