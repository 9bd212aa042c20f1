/* What both programs have in common as processes: their standard streams, and the signals that end them. */
#ifndef LIMPHOME_PROCESS_H
#define LIMPHOME_PROCESS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Opens those of stdin, stdout and stderr that are closed on /dev/null, so that no file of ours gets the number of one
 * and what is printed ends up in it; and lets a write to a pipe that nobody reads fail instead of ending the program.
 */
void process_prepare_streams(void);

/* Has `handler` called by SIGINT, SIGTERM and SIGHUP; by the last not where it was ignored from the start (nohup). */
void process_end_on_signals(void (*handler)(int));

#ifdef __cplusplus
}
#endif
#endif
