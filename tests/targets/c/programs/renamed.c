#define FIELDSCRIBE_IMPLEMENTATION
#include "kitchen_uss_uss.h"
int main(void)
{
    const kitchen_uss_with_old_normalisation_and_old_reference_frequency with = {0U, 0x42480000U};
    int16_t raw = 0;
    const fieldscribe_uss_request request = fieldscribe_uss_read(3U, &kitchen_uss_old_command_source_frame.read);
    return request.parameter == kitchen_uss_command_source_frame.read.parameter &&
            kitchen_uss_old_maximum_frequency_eeprom_frame.write.parameter == 1082U &&
            kitchen_uss_old_main_setpoint_encode_count(4000000, &with, &raw) == FIELDSCRIBE_OK && raw == 0x3333 &&
            kitchen_uss_old_command_source_name(KITCHEN_USS_OLD_COMMAND_SOURCE_TERMINALS) != NULL
        ? 0
        : 1;
}
