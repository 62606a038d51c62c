/**
 * Hand the microphone's samples on as they come, 2048 at a time, as 16-bit integers. Runs in the
 * browser's audio thread, hence a file of its own and no TypeScript.
 */
/* global AudioWorkletProcessor, registerProcessor */
const BLOCK = 2048; // 4096 bytes, the most that the planner takes in a frame

class Samples extends AudioWorkletProcessor {
  constructor() {
    super();
    this.block = new Int16Array(BLOCK);
    this.at = 0;
  }

  process(inputs) {
    for (const sample of inputs[0]?.[0] ?? []) {
      this.block[this.at] = Math.round(Math.max(-1, Math.min(1, sample)) * 32767);
      this.at += 1;
      if (this.at === BLOCK) {
        this.port.postMessage(this.block.slice().buffer);
        this.at = 0;
      }
    }
    return true;
  }
}

registerProcessor("samples", Samples);
