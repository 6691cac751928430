#define dialogue woodward_mpu2s_can_dialogue
static bool late = true; /* an answer of an earlier question is still there */
static void discard(void)
{
    late = false;
}
static void send(fieldscribe_can_frame *asked)
{
    const fieldscribe_can_content content = {
        1U, woodward_mpu2s_password_level_2_frame.read.address, late ? 7U : 8U};
    if (fieldscribe_can_build(dialogue.profile, dialogue.read_answer, &content, asked) != FIELDSCRIBE_CAN_OK) {
        exit(9);
    }
}
int main(void)
{
    const uint8_t unit = 1U;
    fieldscribe_can_frame frame;
    fieldscribe_can_status status;
    uint16_t word = 0U;
    uint16_t raw = 0U;
    bool fits;
    @RECIPE@
    return status == FIELDSCRIBE_CAN_OK && fits && raw == 8U ? 0 : 1;
}
