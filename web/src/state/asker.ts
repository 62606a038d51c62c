/** Know who asks: what a role may not ask is not asked, and so never refused in the console. */
import { computed, signal } from "@preact/signals";
import { fetchAsker, type Asker } from "../net/api";

/** Null until the planner has told it. */
export const asker = signal<Asker | null>(null);

/** Whoever may give an order may ask what it would do. */
export const mayForesee = computed(() => asker.value !== null && asker.value.role !== "viewer");
/** People's words may stand in what a model wrote. */
export const mayReadReplies = computed(() => asker.value?.role === "operator");
/** Settings are the owner's alone; null: nobody knows yet. */
export const isOwner = computed(() => asker.value?.isOwner ?? null);

/** Learn whose token this page holds; where nobody tells it, only what all may is asked. */
export async function learnAsker(): Promise<void> {
  asker.value = await fetchAsker().catch(() => null);
}
