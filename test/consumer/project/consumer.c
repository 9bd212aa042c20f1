/* A caller in the style of C89, which gcc still compiles as such with -std=gnu89. */
#include <limphome/limphome.h>
#include <stdio.h>

static lh_learner learner;

int main(void) {
    lh_learner_config config = lh_learner_config_default();
    float states[6] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
    lh_choice choice;
    lh_error error;

    error = lh_learner_init(&learner, &config, 6, 4, 1);
    if (error != LH_OK) {
        printf("%s\n", lh_error_text(error));
        return 1;
    }
    lh_learner_evaluate(&learner, states);
    choice = lh_learner_choose(&learner, 1.0f, false);
    printf("%d of %d actions\n", (int)choice.action, (int)learner.num_actions);
    return learner.num_actions == 81 ? 0 : 1;
}
