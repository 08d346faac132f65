// Undo: the states that the user went through, and the place among them.

const TOGETHER_MS = 1000, MOST_STEPS = 300;

/// Lists are the same if they have the same members in the same order.
const is_same = (a, b) => a === b ||
  Array.isArray(a) && Array.isArray(b) && a.length === b.length && a.every((member, i) => member === b[i]);

export class Steps {
  #states = [];
  #at = -1;
  #last = {what: "", time: -Infinity};
  get can_undo() { return this.#at > 0; }
  get can_redo() { return this.#at + 1 < this.#states.length; }
  /// Notes a state, an object, if it differs from the present one. What was undone is gone then. Changes of the same
  /// members are one step while something moves, and at most a second passes between two of them.
  note(state, moving, now) {
    const present = this.#states[this.#at];
    const what = Object.keys(state).filter(name => !present || !is_same(state[name], present[name])).join();
    if (!what) return;
    const goes_on = moving && what === this.#last.what && now - this.#last.time < TOGETHER_MS && this.#at > 0;
    this.#states.splice(goes_on ? this.#at : this.#at + 1, Infinity, state);
    if (this.#states.length > MOST_STEPS) this.#states.shift();
    this.#at = this.#states.length - 1;
    this.#last = moving ? {what, time: now} : {what: "", time: -Infinity};
  }
  /// The state so many steps from the present, which is the present then; undefined if there is none.
  go(steps) {
    const state = this.#states[this.#at + steps];
    if (!state) return undefined;
    this.#at += steps;
    this.#last = {what: "", time: -Infinity};
    return state;
  }
  /// Changes every state.
  change(run) { this.#states = this.#states.map(run); }
}
