import { describe, expect, it } from "vitest";
import { homeWhenLow } from "../src/panels/HomeWhenLow";
import type { StandingOrder } from "../src/wire/types";

const order: StandingOrder = {
  id: "o1",
  text: "when the battery is low, go home",
  when: { en: "", zh: "" },
  does: { en: "", zh: "" },
  rule: { event: "battery_low" },
  may: [{ kind: "return_home" }],
  state: "active",
  resumes: null,
  next: null,
  fired: 0,
  missed: 0,
};

describe("the switch for going home on a low battery", () => {
  it("finds the order by what it does, however it was said", () => {
    expect(homeWhenLow([{ ...order, text: "电量低就回家", state: "paused" }])?.id).toBe("o1");
  });

  it("takes no other order for it", () => {
    expect(homeWhenLow([{ ...order, state: "ended" }])).toBeUndefined();
    expect(homeWhenLow([{ ...order, rule: { event: "person_seen" } }])).toBeUndefined();
    expect(homeWhenLow([{ ...order, rule: {} }])).toBeUndefined();
    expect(homeWhenLow([{ ...order, may: [] }])).toBeUndefined();
    const two = [{ kind: "return_home" }, { kind: "say" }];
    expect(homeWhenLow([{ ...order, may: two }])).toBeUndefined();
  });
});
