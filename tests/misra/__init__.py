"""MISRA C:2012 by cppcheck's addon: what stays in generated C, by rule, with how often and why."""
