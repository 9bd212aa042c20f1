/* A caller in the style of C89, which gcc still compiles as such with -std=gnu89. */
#include <limphome/limphome.h>
#include <stdio.h>

static lh_q_learning learner;

int main(void) {
    lh_q_learning_config config = lh_q_learning_config_default();
    float states[6] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
    lh_choice choice;
    lh_error error;

    error = lh_q_learning_init(&learner, &config, 6, 4, 1);
    if (error != LH_OK) {
        printf("%s\n", lh_error_text(error));
        return 1;
    }
    lh_q_learning_evaluate(&learner, states);
    lh_q_learning_choose(&learner, 1.0f, false, &choice);
    printf("%d of %d actions\n", (int)choice.action, (int)learner.num_actions);
    return learner.num_actions == 81 ? 0 : 1;
}
